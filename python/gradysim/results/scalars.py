"""The single numbers of a run, under names in OMNeT++'s manner."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from gradysim.protocol.plain_value import as_float, key_text
from gradysim.results.run_result import NodeResult, RunResult

_MEDIUM = {"frames": "radioMedium", "copies": "communicationMedium"}
"""{what fates are of: the module of the network that decides them}."""


@dataclass(frozen=True)
class Scalar:
    """One number.

    Attributes:
        module: The whole path, which begins with the name of the network.
    """

    module: str
    name: str
    value: float
    attributes: Mapping[str, str] = field(default_factory=dict)


def scalars(result: RunResult, network: str) -> Iterator[Scalar]:
    """Give the numbers of a run; the paths of their modules begin with `network`."""
    yield Scalar(network, "simTime", result.sim_time_s, {"unit": "s"})
    yield Scalar(network, "wallTime", result.wall_s, {"unit": "s"})
    yield Scalar(network, "cpuTime", result.cpu_s, {"unit": "s"})
    yield _count(network, "event", result.events)
    for what, kinds in result.fates.items():
        module = f"{network}.{_MEDIUM[what]}" if what in _MEDIUM else network
        suffix = "" if what in _MEDIUM else "Message"
        yield from _fates(module, kinds, suffix)
    for kind, delays in result.message_delays.items():
        for mode, value_s in (("mean", delays.mean_s), ("max", delays.max_s)):
            yield _recorded(network, f"{kind}Message:delay", mode, value_s, {"unit": "s"})
    for node in result.nodes:
        yield from _of_node(node, f"{network}.{node.name}")


def _of_node(node: NodeResult, module: str) -> Iterator[Scalar]:
    for name, value in node.tracked_variables.items():
        if (number := as_float(value)) is not None:
            yield _last(f"{module}.protocol", key_text(name), number)
    for axis, coordinate in zip("XYZ", node.position, strict=True):
        yield _last(f"{module}.mobility", f"position{axis}", coordinate, {"unit": "m"})
    for bitrate_bps, frames in node.frames_by_bitrate.items():
        yield _count(module, f"unicast:{bitrate_bps / 1e6:g}Mbps", frames)
    yield from _fates(module, node.frame_fates or {})
    for interferer, copies in (node.interferers or {}).items():
        yield _count(module, f"interferer:{interferer}", copies)
    for interface, kinds in (node.message_fates or {}).items():
        yield from _fates(f"{module}.{interface}", kinds, "Message")


def _fates(module: str, kinds: Mapping[str, Mapping[str, int]], suffix: str = "") -> Iterator[Scalar]:
    for kind, counts in kinds.items():
        for fate, count in counts.items():
            yield _count(module, f"{_camel_case(kind)}{suffix}:{_camel_case(fate)}", count)


def _count(module: str, name: str, count: int) -> Scalar:
    return _recorded(module, name, "count", count)


def _last(module: str, name: str, value: float, attributes: Mapping[str, str] | None = None) -> Scalar:
    return _recorded(module, name, "last", value, attributes)


def _recorded(
    module: str, name: str, mode: str, value: float, attributes: Mapping[str, str] | None = None
) -> Scalar:
    told = {**(attributes or {}), "source": name, "recordingmode": mode}
    return Scalar(module, f"{name}:{mode}", value, told)


def _camel_case(text: str) -> str:
    """Return `unicast overheard` and `below_sensitivity` as OMNeT++'s models would call them."""
    return re.sub(r"[ _](\w)", lambda match: match[1].upper(), text)
