"""Capture files: what radios sent and received, one pcap file for each radio."""

import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.engine_errors import errors_at, settings_by_target
from gradysim.replay.sink import OutputError
from gradysim.results.durable import finished_name
from gradysim.results.recorder import checked_ids
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.scenario import Scenario, nodes_named

if TYPE_CHECKING:
    from gradysim._netsim import Network


_EXPECTED = "a file for each id of a node, such as {0: 'node.pcap'}"


class CaptureError(OutputError):
    """A capture file lacks its end. The message says which one and why."""


def capture_files(scenario: Scenario, names: Iterable[str], directory: Path) -> dict[int, Path]:
    """Return {id of a node: the file for what it sends and receives}, in the order of ids.

    `names` are those of nodes (`uavs[0]`), of groups (`uavs`), or `all`; names that do not exist are ignored.
    The files are `directory`/CONFIG-#RUN-NODE.pcap.
    """
    prefix = f"{scenario.config}-#{scenario.run_number}"
    return {node.id: directory / f"{prefix}-{node.name}.pcap" for node in nodes_named(scenario, names)}


def checked_captures(captures: Mapping[int, str | Path], scenario: Scenario) -> dict[int, Path]:
    """Return the files for the ids of nodes that a script passes.

    Raises TypeError for arguments of another kind, and ValueError for a node that does not exist and for a
    file that two interfaces would write.
    """
    if not isinstance(captures, Mapping):
        raise TypeError(f"captures = {captures!r:.80}: expected {_EXPECTED}")
    ids = checked_ids("captures", captures, len(scenario.nodes), _EXPECTED)
    try:
        files = {node_id: Path(file) for node_id, file in zip(ids, captures.values(), strict=True)}
    except TypeError:
        raise TypeError(f"captures = {captures!r:.80}: expected {_EXPECTED}") from None
    writers: dict[Path, str] = {}
    for (node_id, index), file in files_of_interfaces(scenario, files).items():
        interface = f"wlan[{index}] of node {node_id}"
        other = writers.setdefault(file.resolve(), interface)
        if other != interface:
            raise ValueError(
                f"captures: {other} and {interface} would write one file, '{file}'; expected one for each"
            )
    return files


def files_of_interfaces(scenario: Scenario, files: Mapping[int, Path]) -> dict[tuple[int, int], Path]:
    """Return {(id of a node, index of its interface): file}: that of wlan[1] is FILE-wlan1.pcap."""
    return {
        (node_id, index): _file_of_interface(file, index)
        for node_id, file in files.items()
        for index in range(len(scenario.nodes[node_id].wlan))
    }


def _file_of_interface(file: Path, index: int) -> Path:
    if not index:
        return file
    finished = file.with_name(finished_name(file.name) or file.name)
    end = file.name.removeprefix(finished.name)
    return file.with_name(f"{finished.stem}-wlan{index}{finished.suffix}{end}")


def start_captures(network: "Network", scenario: Scenario, files: Mapping[int, Path]) -> None:
    """Open the capture files of all interfaces of these nodes, and create missing directories.

    Raises ConfigError for a file that cannot be written, and for a medium without radios.
    """
    for (node_id, index), file in files_of_interfaces(scenario, files).items():
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ConfigError(f"cannot write the capture file '{file}': {error.strerror}") from error
        with errors_at(settings_by_target("medium", scenario.medium)):
            network.capture(node_id, os.fsencode(file), index)


@contextmanager
def capture_errors() -> Iterator[None]:
    """Raise the engine's error about completing captures as a CaptureError."""
    netsim = load_netsim()
    try:
        yield
    except netsim.ProtocolError:  # a subclass
        raise
    except netsim.SimulationError as error:
        raise CaptureError(str(error)) from None
