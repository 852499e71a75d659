"""Reads the networks of runs: nodes, medium and obstacles. Runs that read the same values share one."""

from collections.abc import Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

from gradysim.scenario.build.geojson import read_obstacle_files
from gradysim.scenario.build.nodes import build_nodes
from gradysim.scenario.build.obstacles import read_obstacles
from gradysim.scenario.errors import ConfigError, ErrorCollector, Source
from gradysim.scenario.obstacle_spec import ObstacleSpec
from gradysim.scenario.parse.distributions import distribution_in
from gradysim.scenario.parse.expressions import differs_between_parameters
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.resolve.groups import Group, find_groups
from gradysim.scenario.resolve.lines import Lines, read_struct
from gradysim.scenario.resolve.resolution import Resolution, resolve
from gradysim.scenario.resolve.runs import FileHashes, UnreadVariables, line_instead, unread_variables
from gradysim.scenario.resolve.sweep import IterationVariable, depends_on_run, substitute, substituted
from gradysim.scenario.resolve.unknown_keys import NoSuchNodeError, check_names, check_parameters
from gradysim.scenario.scenario import CommunicationMediumSpec
from gradysim.scenario.schema.keys import OBSTACLE_FILE
from gradysim.scenario.schema.native_protocols import file_of_native
from gradysim.scenario.schema.options import is_ignored, is_option
from gradysim.scenario.schema.parameter_types import ParameterType
from gradysim.scenario.schema.protocols import ProtocolLoader
from gradysim.scenario.schema.values import Setting, SettingReader, read_scalar

Key = tuple[int, ...]
"""Sources of the values of a run's network."""


class ResolvedNetwork(NamedTuple):
    """The lines of a run's network, before their values are read.

    Attributes:
        resolution: Its rows.
        lines_of_other_runs: Lines about nodes that this run does not have, and other runs may have.
    """

    resolution: Resolution
    lines_of_other_runs: Sequence[Source]


class Networks:
    """Reads the networks of runs. Those that were read for a check are kept."""

    def __init__(self, lines: Sequence[Entry], folder: Path, instead: str, source: Source) -> None:
        """Prepare for the first run. `lines` have variables; for the others see `resolve_network`."""
        self._lines = lines
        self._instead = instead
        self._source = source
        self._loader, self._hashes = ProtocolLoader(), FileHashes(folder)
        self._parameters = [entry for entry in lines if not is_option(entry) and not is_ignored(entry)]
        self._known: dict[tuple[Key, int | None], Mapping[str, Any]] = {}  # no seed: it is the same for all
        self._right_for_all_seeds: set[Key] = set()
        self._resolved: dict[Key, ResolvedNetwork] = {}  # those that are the same for all seeds
        self._last: ResolvedNetwork | None = None
        self._of_other_runs: list[Sequence[Source]] = []
        self._read: set[Source] = set()
        self._types: dict[Source, set[ParameterType]] = {}

    def check(self, key: Key, variables: Mapping[str, str], seed: int) -> None:
        """Read the network of a run and keep it. Raises ConfigError for anything that is wrong."""
        settings, errors = SettingReader(seed), ErrorCollector()
        resolved = self._last = self._resolution_of(key, variables, settings, errors)
        if not settings.has_values_of_parameters():
            self._resolved[key] = resolved
        fields = build_network(resolved.resolution, settings, self._hashes, errors)
        if settings.is_right_for_all_seeds():
            self._right_for_all_seeds.add(key)
        self._known[key, self._seed_of_draws(variables, seed)] = fields
        self._of_other_runs.append(resolved.lines_of_other_runs)
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
        if known is None:
            settings, errors = SettingReader(seed), ErrorCollector()
            resolved = self._resolution_of(key, variables, settings, errors)
            known = build_network(resolved.resolution, settings, self._hashes, errors)
        return known

    def _seed_of_draws(self, variables: Mapping[str, str], seed: int) -> int | None:
        draws = any(distribution_in(substitute(entry, variables).text) for entry in self._parameters)
        return seed if draws else None

    def _resolution_of(
        self, key: Key, variables: Mapping[str, str], settings: SettingReader, errors: ErrorCollector
    ) -> ResolvedNetwork:
        if key in self._resolved:
            return self._resolved[key]
        entries = substituted(self._lines, variables)
        return resolve_network(entries, settings, self._loader, errors, self._instead, self._source)

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
        return tuple(
            UnreadVariables(line, names, line_instead(line, self._last.resolution))
            for line, names in unread_variables(self._lines, variables, self._read).items()
        )


def resolve_network(
    entries: list[Entry],
    settings: SettingReader,
    loader: ProtocolLoader,
    errors: ErrorCollector,
    instead: str,
    source: Source,
) -> ResolvedNetwork:
    """Return the lines of a run's network, whose entries have values instead of variables.

    `instead` is the end of messages about nodes that do not exist, `source` the source of the configuration.
    `errors` takes the errors. Raises ConfigError for all that is wrong if there are no nodes.
    """
    lines = Lines(entries)
    groups = find_groups(lines, settings, errors)
    lines_of_other_runs = check_names(lines, groups, errors)
    errors.errors = [
        error.with_hint(instead) if isinstance(error, NoSuchNodeError) else error for error in errors.errors
    ]
    resolution = resolve(lines, groups, settings, loader, errors)
    if not resolution.kinds:
        errors.raise_all()
        raise _no_nodes(groups, instead, source)
    check_parameters(resolution, errors)
    return ResolvedNetwork(resolution, lines_of_other_runs)


def build_network(
    resolution: Resolution, settings: SettingReader, hashes: FileHashes, errors: ErrorCollector
) -> dict[str, Any]:
    """Return the fields of a Scenario that are its network: nodes, medium and obstacles.

    Raises ConfigError for all that is wrong, and for what `errors` has.
    """

    def read(struct: str) -> dict[str, Setting]:
        return read_struct(struct, resolution.of_network.values(), settings, errors)

    communication, reference = read("communication_medium"), read("reference")
    latitude, longitude, altitude = (
        float(reference[field].value) if field in reference else 0.0
        for field in ("latitude_deg", "longitude_deg", "altitude_m")
    )
    nodes = build_nodes(resolution, settings, errors)
    medium, wind = read("medium"), read("wind")
    obstacles = read_obstacles(resolution, settings, errors)
    obstacle_files: dict[Path, tuple[ObstacleSpec, ...]] = {}
    with errors.collecting():
        is_placed = {"latitude_deg", "longitude_deg"} <= reference.keys()
        obstacle_files = read_obstacle_files(
            resolution.of_network.get(OBSTACLE_FILE.path),
            settings,
            (latitude, longitude, altitude) if is_placed else None,
        )
    errors.raise_all()
    chosen = {kind.protocol for kind in resolution.kinds.values()}
    files = [file for protocol in chosen for file in protocol.files]
    files += [*obstacle_files, *settings.files()]
    return {
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
        "resolution": resolution,
    }


def _no_nodes(groups: Sequence[Group], instead: str, source: Source) -> ConfigError:
    for group in groups:  # each has a number of nodes, and it is 0
        if group.size_line is not None:
            size = group.size_line.entry.source
            return ConfigError.at(size, "there are no nodes", expected="at least one", hint=instead)
    return ConfigError("there are no nodes", source, expected="some, such as `*.numUavs = 2`", hint=instead)
