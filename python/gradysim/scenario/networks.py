"""Reads the networks of runs: nodes, medium and obstacles. Runs that read the same values share one."""

from collections.abc import Mapping, Sequence
from itertools import chain
from operator import attrgetter
from pathlib import Path
from typing import Any, NamedTuple

from gradysim.scenario.distributions import distribution_in
from gradysim.scenario.errors import ConfigError, ErrorCollector, Source
from gradysim.scenario.expressions import differs_between_parameters
from gradysim.scenario.geojson import read_obstacle_files
from gradysim.scenario.groups import Group, find_groups
from gradysim.scenario.ini import Entry
from gradysim.scenario.interfaces import interface_count
from gradysim.scenario.keys import NETWORK_KEYS
from gradysim.scenario.lookup import Lookup, SettingReader, is_ignored, is_option, read_scalar, read_struct
from gradysim.scenario.native_protocols import file_of_native
from gradysim.scenario.nodes import build_nodes, load_protocols
from gradysim.scenario.obstacles import ObstacleSpec, obstacle_count, read_obstacles
from gradysim.scenario.parameter_types import ParameterType
from gradysim.scenario.protocols import ProtocolLoader
from gradysim.scenario.runs import FileHashes, UnreadVariables, line_instead, unread_variables
from gradysim.scenario.scenario import CommunicationMediumSpec
from gradysim.scenario.sweep import IterationVariable, depends_on_run, substitute, substituted
from gradysim.scenario.unknown_keys import (
    NoSuchNodeError,
    ProtocolAndInterfaces,
    check_names,
    check_parameters,
)

Key = tuple[int, ...]
"""Places of the values of a run's network."""


class Network(NamedTuple):
    """The network of a run: nodes, medium and obstacles.

    Attributes:
        fields: Those of a Scenario, by name.
        lines_of_other_runs: Lines about nodes that this run does not have, and other runs may have.
        lookup: The lines in force.
    """

    fields: Mapping[str, Any]
    lines_of_other_runs: Sequence[Source]
    lookup: Lookup


class Networks:
    """Reads the networks of runs. Those that were read for a check are kept."""

    def __init__(self, lines: Sequence[Entry], folder: Path, instead: str, source: Source) -> None:
        """Prepare for the first run. `lines` have variables; for the others see `read_network`."""
        self._lines = lines
        self._instead = instead
        self._source = source
        self._loader, self._hashes = ProtocolLoader(), FileHashes(folder)
        self._parameters = [entry for entry in lines if not is_option(entry) and not is_ignored(entry)]
        self._known: dict[tuple[Key, int | None], Mapping[str, Any]] = {}  # no seed: it is the same for all
        self._right_for_all_seeds: set[Key] = set()
        self._last: Network | None = None
        self._of_other_runs: list[Sequence[Source]] = []
        self._read: set[Source] = set()
        self._types: dict[Source, set[ParameterType]] = {}

    def check(self, key: Key, variables: Mapping[str, str], seed: int) -> None:
        """Read the network of a run and keep it. Raises ConfigError for anything that is wrong."""
        settings = SettingReader(seed)
        network = self._last = self._network(settings, variables)
        if settings.is_right_for_all_seeds():
            self._right_for_all_seeds.add(key)
        self._known[key, self._seed_of_draws(variables, seed)] = network.fields
        self._of_other_runs.append(network.lines_of_other_runs)
        self._read |= settings.lines_read()
        for line, kind in settings.types_read():
            self._types.setdefault(line, set()).add(kind)

    def is_checked(self, key: Key, seed: int) -> bool:
        """Return whether the network of a run was checked, or one with another seed that decides for all."""
        return key in self._right_for_all_seeds or (key, seed) in self._known

    def check_values(self, variables: Mapping[str, str]) -> None:
        """Check the values of a run by themselves, as the types that checked networks read their lines as.

        Raises ConfigError for all that are wrong.
        """
        errors = ErrorCollector()
        for entry in self._parameters:
            if depends_on_run(entry):
                value = substitute(entry, variables)
                for kind in self._types.get(entry.source, ()):
                    if not differs_between_parameters(value.text):
                        with errors.collecting():
                            read_scalar(value, kind)
        errors.raise_all()

    def of_run(self, key: Key, variables: Mapping[str, str], seed: int) -> Mapping[str, Any]:
        """Return the fields of a run's Scenario that are its network. Raises ConfigError."""
        known = self._known.get((key, None)) or self._known.get((key, seed))
        return known or self._network(SettingReader(seed), variables).fields

    def _seed_of_draws(self, variables: Mapping[str, str], seed: int) -> int | None:
        draws = any(distribution_in(substitute(entry, variables).text) for entry in self._parameters)
        return seed if draws else None

    def _network(self, settings: SettingReader, variables: Mapping[str, str]) -> Network:
        entries = substituted(self._lines, variables)
        return read_network(entries, settings, self._loader, self._hashes, self._instead, self._source)

    def check_lines_of_other_runs(self) -> None:
        """Raise ConfigError for the lines that all checked networks leave to other runs."""
        errors = ErrorCollector()
        first, *others = self._of_other_runs
        for line in first:
            if all(line in lines for lines in others):
                problem, expected = f"`{line.key}` matches no node in any run", "a node that some run has"
                errors.add(NoSuchNodeError(problem, line, expected=expected))
        errors.raise_all()

    def unread(self, variables: Sequence[IterationVariable]) -> tuple[UnreadVariables, ...]:
        """Return the variables that no checked network has read."""
        assert self._last is not None
        nodes = [spec.name for spec in self._last.fields["nodes"]]
        return tuple(
            UnreadVariables(line, names, line_instead(line, self._last.lookup, nodes))
            for line, names in unread_variables(self._lines, variables, self._read).items()
        )


def read_network(
    entries: list[Entry],
    settings: SettingReader,
    loader: ProtocolLoader,
    hashes: FileHashes,
    instead: str,
    source: Source,
) -> Network:
    """Read the network of a run, whose entries have values instead of variables.

    `instead` is the end of messages about nodes that do not exist, `source` the place of the configuration.
    Raises ConfigError for all that is wrong.
    """
    errors = ErrorCollector()
    lookup = Lookup(entries)
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
    path_of = attrgetter("path")
    communication = read_struct("communication_medium", found, settings, path_of, errors)
    reference = read_struct("reference", found, settings, path_of, errors)
    latitude, longitude, altitude = (
        float(reference[field].value) if field in reference else 0.0
        for field in ("latitude_deg", "longitude_deg", "altitude_m")
    )
    nodes = build_nodes(lookup, groups, protocols, counts, settings, errors)
    medium = read_struct("medium", found, settings, path_of, errors)
    wind = read_struct("wind", found, settings, path_of, errors)
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
        {
            "nodes": nodes,
            "medium": medium,
            "wind": {field: float(setting.value) for field, setting in wind.items()},
            "communication_medium": CommunicationMediumSpec(
                **{field: float(setting.value) for field, setting in communication.items()},
                range_source=given.source if (given := communication.get("transmission_range_m")) else None,
            ),
            "reference_coordinates": (latitude, longitude, altitude),
            "obstacles": (*obstacles, *chain.from_iterable(obstacle_files.values())),
            "file_hashes": hashes.of(files, file_of_native(protocol.cls for protocol in chosen)),
        },
        lines_of_other_runs,
        lookup,
    )


def _no_nodes(groups: Sequence[Group], instead: str, source: Source) -> ConfigError:
    for group in groups:  # each has a number of nodes, and it is 0
        if group.size_found is not None:
            size = group.size_found.entry.source
            return ConfigError.at(size, "there are no nodes", expected="at least one", hint=instead)
    return ConfigError("there are no nodes", source, expected="some, such as `*.numUavs = 2`", hint=instead)
