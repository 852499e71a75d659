"""The network of a run: nodes, medium and obstacles. Runs that do not differ in them share one."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import NamedTuple

from gradysim.scenario.distributions import distribution_in
from gradysim.scenario.errors import ConfigError, ErrorCollector, Source
from gradysim.scenario.geojson import read_obstacle_files
from gradysim.scenario.groups import Group, find_groups
from gradysim.scenario.ini import Entry, Ranked
from gradysim.scenario.interfaces import interface_count
from gradysim.scenario.keys import NETWORK_KEYS
from gradysim.scenario.lookup import Lookup, is_ignored, is_option, read_struct
from gradysim.scenario.native_protocols import file_of_native
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.nodes import build_nodes, load_protocols
from gradysim.scenario.obstacles import ObstacleSpec, obstacle_count, read_obstacles
from gradysim.scenario.protocols import ProtocolLoader
from gradysim.scenario.runs import FileHashes, UnreadVariables, line_instead, unread_variables
from gradysim.scenario.scenario import CommunicationMediumSpec
from gradysim.scenario.schema import Key
from gradysim.scenario.settings import Setting, SettingReader
from gradysim.scenario.sweep import IterationVariable, depends_on_run, substitute, substituted
from gradysim.scenario.unknown_keys import (
    NoSuchNodeError,
    ProtocolAndInterfaces,
    check_names,
    check_parameters,
)


@dataclass(frozen=True)
class Network:
    """Fields of a scenario that describe its network, and what is needed to compare runs.

    Attributes:
        lines_of_other_runs: Lines about nodes that this run does not have, and other runs may have.
        lookup: The lines in force.
    """

    nodes: tuple[NodeSpec, ...]
    medium: Mapping[str, Setting]
    communication_medium: CommunicationMediumSpec
    reference_coordinates: tuple[float, float, float]
    obstacles: tuple[ObstacleSpec, ...]
    file_hashes: Mapping[str, str]
    lines_of_other_runs: Sequence[Source]
    lookup: Lookup


def read_network(
    ranked: list[Ranked],
    settings: SettingReader,
    loader: ProtocolLoader,
    hashes: FileHashes,
    instead: str,
    source: Source,
) -> Network:
    """Read the network of a run.

    Args:
        ranked: The entries of the run, with its values instead of variables.
        settings: Reads their values.
        loader: Loads protocols.
        hashes: Hashes of the files that values name.
        instead: The end of messages about nodes that do not exist.
        source: The place of the configuration.

    Raises:
        ConfigError: Anything is wrong; all errors are reported together.
    """
    errors = ErrorCollector()
    lookup = Lookup(ranked)
    groups = find_groups(lookup, settings, errors)
    lines_of_other_runs = check_names(lookup, groups, errors)
    errors.errors = [
        error.with_hint(instead) if isinstance(error, NoSuchNodeError) else error for error in errors.errors
    ]
    protocols = load_protocols(lookup, groups, settings, loader, errors)
    if not protocols:
        errors.raise_all()
        raise _no_nodes(groups, instead, source)
    counts = {name: interface_count(name, lookup, settings, errors) for name in protocols}
    obstacles_below = obstacle_count(lookup, settings, errors)
    kinds = {name: ProtocolAndInterfaces(protocol.cls, counts[name]) for name, protocol in protocols.items()}
    check_parameters(lookup, groups, kinds, obstacles_below, errors)

    found = {
        key: entry for key in NETWORK_KEYS if (entry := lookup.first(*key.path.split(".", 1))) is not None
    }
    communication = read_struct("communication_medium", found, settings, _path_of, errors)
    reference = read_struct("reference", found, settings, _path_of, errors)
    latitude, longitude, altitude = (
        float(reference[field].value) if field in reference else 0.0
        for field in ("latitude_deg", "longitude_deg", "altitude_m")
    )
    nodes = build_nodes(lookup, groups, protocols, counts, settings, errors)
    medium = read_struct("medium", found, settings, _path_of, errors)
    obstacles = read_obstacles(obstacles_below, lookup, settings, errors)
    obstacle_files: dict[Path, tuple[ObstacleSpec, ...]] = {}
    with errors.collecting():
        is_placed = {"latitude_deg", "longitude_deg"} <= reference.keys()
        obstacle_files = read_obstacle_files(
            lookup, settings, (latitude, longitude, altitude) if is_placed else None
        )
    errors.raise_all()
    chosen = set(protocols.values())
    files = [file for protocol in chosen for file in protocol.files]
    files += [*obstacle_files, *settings.files()]
    return Network(
        nodes=nodes,
        medium=medium,
        communication_medium=CommunicationMediumSpec(
            **{field: float(setting.value) for field, setting in communication.items()}
        ),
        reference_coordinates=(latitude, longitude, altitude),
        obstacles=(*obstacles, *chain.from_iterable(obstacle_files.values())),
        file_hashes=hashes.of(files, file_of_native(protocol.cls for protocol in chosen)),
        lines_of_other_runs=lines_of_other_runs,
        lookup=lookup,
    )


def _no_nodes(groups: Sequence[Group], instead: str, source: Source) -> ConfigError:
    for group in groups:  # each has a number of nodes, and it is 0
        if group.size_found is not None:
            size = group.size_found.entry.source
            return ConfigError.at(size, "there are no nodes", expected="at least one", hint=instead)
    return ConfigError("there are no nodes", source, expected="some, such as `*.numUavs = 2`", hint=instead)


def _path_of(key: Key) -> str:
    """Return the path of a parameter of the network."""
    return key.path


class _Read(NamedTuple):
    """A network with what it was made from."""

    texts: list[str]
    seed: int
    network: Network
    settings: SettingReader


class Networks:
    """Reads the networks of runs, one after another."""

    def __init__(self, ranked: Sequence[Ranked], folder: Path, instead: str, source: Source) -> None:
        """Prepare for the first run.

        Args:
            ranked: The entries of the configuration, with variables.
            folder: The directory of the .ini file.
            instead: The end of messages about nodes that do not exist.
            source: The place of the configuration.
        """
        self._ranked = ranked
        self._instead = instead
        self._source = source
        self._loader, self._hashes = ProtocolLoader(), FileHashes(folder)
        parameters = [entry for _, entry in ranked if not is_option(entry) and not is_ignored(entry)]
        self._varying = [entry for entry in parameters if depends_on_run(entry)]
        self._always_draws = any(distribution_in(entry.text) for entry in parameters)
        self._last: _Read | None = None
        self._of_other_runs: list[Sequence[Source]] = []
        self._read: set[Source] = set()

    def of_run(self, variables: Mapping[str, str], seed: int) -> Network:
        """Return the network of a run: that of the previous run if the same lines make it.

        Raises ConfigError for anything that is wrong.
        """
        network, is_its_own = self.checked(variables, seed)
        return network if is_its_own else self._read_network(self._texts(variables), variables, seed)

    def checked(self, variables: Mapping[str, str], seed: int) -> tuple[Network, bool]:
        """Return the network of a run, or one with another seed that is valid if and only if this one is.

        Also returns whether it is that of the run. Raises ConfigError for anything that is wrong.
        """
        texts, last = self._texts(variables), self._last
        if last is None or texts != last.texts:
            return self._read_network(texts, variables, seed), True
        if seed == last.seed or not (self._always_draws or any(map(distribution_in, texts))):
            return last.network, True
        if last.settings.is_right_for_all_seeds():
            return last.network, False
        return self._read_network(texts, variables, seed), True

    def _texts(self, variables: Mapping[str, str]) -> list[str]:
        """Return the values that differ between networks, before any are drawn."""
        return [substitute(entry, variables).text for entry in self._varying]

    def _read_network(self, texts: list[str], variables: Mapping[str, str], seed: int) -> Network:
        settings = SettingReader(seed)
        entries = substituted(self._ranked, variables)
        network = read_network(entries, settings, self._loader, self._hashes, self._instead, self._source)
        self._of_other_runs.append(network.lines_of_other_runs)
        self._read |= settings.lines_read()
        self._last = _Read(texts, seed, network, settings)
        return network

    def check_lines_of_other_runs(self) -> None:
        """Raise ConfigError for the lines that all runs leave to other runs."""
        errors = ErrorCollector()
        first, *others = self._of_other_runs
        for line in first:
            if all(line in lines for lines in others):
                problem, expected = f"`{line.key}` matches no node in any run", "a node that some run has"
                errors.add(NoSuchNodeError(problem, line, expected=expected))
        errors.raise_all()

    def unread(
        self, lines: Sequence[Entry], variables: Sequence[IterationVariable]
    ) -> tuple[UnreadVariables, ...]:
        """Return the variables, in these lines of the configuration, that no run has read."""
        assert self._last is not None
        network, settings = self._last.network, self._last.settings
        nodes, parameters = [spec.name for spec in network.nodes], settings.parameters_read()
        return tuple(
            UnreadVariables(line, names, line_instead(line, network.lookup, nodes, parameters))
            for line, names in unread_variables(lines, variables, self._read).items()
        )
