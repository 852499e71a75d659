"""Reads a configuration of a file as scenarios, one for each run. Runs with the same network share it."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain
from operator import attrgetter
from pathlib import Path
from typing import Any, NamedTuple

from gradysim.scenario.distributions import distribution_in
from gradysim.scenario.errors import OF_SCRIPT, ArgumentNames, ConfigError, ErrorCollector, Source
from gradysim.scenario.geojson import read_obstacle_files
from gradysim.scenario.groups import Group, find_groups
from gradysim.scenario.ini import (
    Entry,
    entries_in_order,
    read_ini,
    read_overrides,
    search_order,
    what_to_run_instead,
)
from gradysim.scenario.interfaces import interface_count
from gradysim.scenario.keys import NETWORK_KEYS
from gradysim.scenario.lookup import (
    Lookup,
    SettingReader,
    is_ignored,
    is_option,
    network_name,
    options_in_force,
    read_scalar,
    read_struct,
)
from gradysim.scenario.native_protocols import file_of_native
from gradysim.scenario.nodes import build_nodes, load_protocols
from gradysim.scenario.obstacles import ObstacleSpec, obstacle_count, read_obstacles
from gradysim.scenario.protocols import ProtocolLoader
from gradysim.scenario.runs import (
    FileHashes,
    UnreadVariables,
    check_seeds_of_runs,
    entries_of_the_hash,
    line_instead,
    numbered_runs,
    seed_of_file,
    settings_hash,
    unread_variables,
    whole_seed,
)
from gradysim.scenario.scenario import CommunicationMediumSpec, Scenario
from gradysim.scenario.schema import OPTIONS
from gradysim.scenario.sweep import (
    IterationVariable,
    depends_on_run,
    free_text,
    name_iterations,
    run_variables,
    substitute,
    substituted,
    with_labels,
)
from gradysim.scenario.unknown_keys import (
    NoSuchNodeError,
    ProtocolAndInterfaces,
    check_names,
    check_option,
    check_parameters,
)

_MOST_FAILED = 20
"""Combinations of iteration variables with errors, after which reading stops."""


def load_scenarios(
    file: str | Path,
    config: str = "General",
    runs: str | Iterable[int] | None = None,
    overrides: Iterable[str] = (),
    seed: int | None = None,
    *,
    names: ArgumentNames = OF_SCRIPT,
) -> list[Scenario]:
    """Read a configuration and check all of it.

    Args:
        file: The .ini file.
        config: Name of the configuration in it.
        runs: Numbers of the wanted runs, or a string such as "0,2,5..9"; None for all.
        overrides: "KEY=VALUE" strings that precede the whole file; of several that match, the first is used.
        seed: Seed of run 0; run N adds N. Each is 0 to 2^63 - 1. None for the seed-set of the file.
        names: Names of these arguments in messages.

    Returns:
        One scenario per run, by run number.

    Raises:
        ConfigError: Anything is wrong. Several errors are a ConfigErrors, whose `errors` are sorted by line.
        TypeError: An argument has the wrong type.
    """
    checked = CheckedScenarios(file, config, runs, overrides, seed, names)
    return [checked.placed(scenario) for scenario in checked.scenarios]


class CheckedScenarios:
    """The checked runs of a configuration.

    Attributes:
        scenarios: One per run, by run number. Those that differ only in their seeds may have the nodes of the
            first of them; `placed` returns them with their own nodes.
    """

    def __init__(
        self,
        file: str | Path,
        config: str,
        runs: str | Iterable[int] | None,
        overrides: Iterable[str],
        seed: int | None,
        names: ArgumentNames,
    ) -> None:
        """Read and check it; arguments and exceptions are those of `load_scenarios`."""
        if not isinstance(config, str):
            raise TypeError(f"{names.config} {config!r}: expected the name of a configuration")
        if seed is not None:
            seed = whole_seed(seed)
        file = Path(file)
        ini = read_ini(file)
        sections = tuple(search_order(ini, config))
        source = sections[0].source
        lines = entries_in_order(read_overrides(file, overrides, names.overrides), sections)
        errors = ErrorCollector()
        for entry in lines:
            if is_option(entry):
                with errors.collecting():
                    check_option(entry)
        try:
            network_of_file = network_name(lines)
            lines, variables = name_iterations(lines)
            as_written = options_in_force(lines)
            numbered, run_count = numbered_runs(as_written, variables, config, runs, source, names.runs)
            if seed is not None:
                check_seeds_of_runs(seed, max((number for number, _, _ in numbered), default=0), names.seed)
        except ConfigError as error:  # without runs there is nothing else to check
            errors.add(error)
            raise errors.combined() from None

        instead = what_to_run_instead(ini, config, sections, names.config)
        networks = self._networks = Networks(lines, file.parent, instead, source)
        self._elsewhere: dict[int, dict[str, str]] = {}  # variables of runs with a network of another seed
        in_force = entries_of_the_hash(lines)
        hashes: dict[tuple[str, ...], str] = {}  # by the values of the iterations: no more of a run is in it
        made: list[Callable[..., Scenario]] = []
        failed: set[tuple[str, ...]] = set()
        for number, repetition, iterations in numbered:
            key = tuple(iterations.values())
            if key in failed:
                continue
            if len(failed) == _MOST_FAILED:
                break
            values = run_variables(file, network_of_file, config, number, repetition, iterations)
            limit_s, of_file = 1.0, 0
            error_count = len(errors.errors)
            with errors.collecting():
                with errors.collecting():
                    of_file = seed_of_file(as_written, number, values)
                seed_of_run = of_file if seed is None else seed + number
                if key not in hashes:
                    hashed = with_labels(values, seed_of_run, as_written, for_hash=True)
                    hashes[key] = settings_hash(substituted(in_force, hashed))
                values = with_labels(values, seed_of_run, as_written)
                options = {name: substitute(entry, values) for name, entry in as_written.items()}
                with errors.collecting():
                    limit_s = _sim_time_limit_s(options, config, source)
                    interval_s = _vector_record_interval_s(options)
                description = _description(options)
                network, is_its_own = networks.checked(values, seed_of_run)
            if len(errors.errors) > error_count:
                failed.add(key)
                continue
            if not is_its_own:
                self._elsewhere[number] = values
            made.append(
                partial(
                    Scenario,
                    file=file,
                    config=config,
                    run_number=number,
                    seed=seed_of_run,
                    description=description,
                    sim_time_limit_s=limit_s,
                    vector_record_interval_s=interval_s,
                    **network.fields,
                    sections=sections,
                    repetition=repetition,
                    iterations=iterations,
                    settings_hash=hashes[key],
                    run_count=run_count,
                    network=network_of_file,
                    lines=tuple(lines),
                )
            )
        errors.raise_all()
        if len(numbered) < run_count:  # the other runs may have more nodes, and read other lines
            self.scenarios = [make() for make in made]
            return
        networks.check_lines_of_other_runs()
        unread = networks.unread(variables)
        self.scenarios = [make(unread_variables=unread) for make in made]

    def placed(self, scenario: Scenario) -> Scenario:
        """Return one of the scenarios with its nodes where they are."""
        variables = self._elsewhere.get(scenario.run_number)
        if variables is None:
            return scenario
        return replace(scenario, **self._networks.of_run(variables, scenario.seed).fields)


def _sim_time_limit_s(options: Mapping[str, Entry], config: str, source: Source) -> float:
    limit = options.get("sim-time-limit")
    if limit is None:
        raise ConfigError(f"`{config}` has no time limit", source, expected="`sim-time-limit = 1h`")
    return float(read_scalar(limit, OPTIONS["sim-time-limit"]))


def _vector_record_interval_s(options: Mapping[str, Entry]) -> float:
    interval = options.get("vector-record-interval")
    return float(read_scalar(interval, OPTIONS["vector-record-interval"])) if interval else 0.0


def _description(options: Mapping[str, Entry]) -> str:
    description = options.get("description")
    return free_text(description) if description else ""


def runs_of(
    file: str | Path, config: str, overrides: Iterable[str] = (), *, names: ArgumentNames = OF_SCRIPT
) -> Sequence[tuple[int, int, Mapping[str, Any]]]:
    """Return number, repetition and values of iterations of each run of a configuration.

    It needs neither nodes nor a time limit, and checks neither. Raises ConfigError.
    """
    sections = tuple(search_order(read_ini(Path(file)), config))
    overridden = read_overrides(Path(file), overrides, names.overrides)
    lines, variables = name_iterations(entries_in_order(overridden, sections))
    as_written = options_in_force(lines)
    return numbered_runs(as_written, variables, config, None, sections[0].source, names.runs)[0]


class Network(NamedTuple):
    """The network of a run: nodes, medium and obstacles.

    Attributes:
        fields: Those of a Scenario, by name.
        lines_of_other_runs: Lines about nodes that this run does not have, and other runs may have.
        lookup: The lines in force.
        settings: What has read their values.
    """

    fields: Mapping[str, Any]
    lines_of_other_runs: Sequence[Source]
    lookup: Lookup
    settings: SettingReader


class Networks:
    """Reads the networks of runs, one after another."""

    def __init__(self, lines: Sequence[Entry], folder: Path, instead: str, source: Source) -> None:
        """Prepare for the first run. `lines` have variables; for the others see `read_network`."""
        self._lines = lines
        self._instead = instead
        self._source = source
        self._loader, self._hashes = ProtocolLoader(), FileHashes(folder)
        parameters = [entry for entry in lines if not is_option(entry) and not is_ignored(entry)]
        self._varying = [entry for entry in parameters if depends_on_run(entry)]
        self._always_draws = any(distribution_in(entry.text) for entry in parameters)
        self._last: tuple[list[str], int, Network] | None = None  # with the values and the seed of its run
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
        texts = self._texts(variables)
        if self._last is not None and self._last[0] == texts:
            _, last_seed, last = self._last
            if seed == last_seed or not (self._always_draws or any(map(distribution_in, texts))):
                return last, True
            if last.settings.is_right_for_all_seeds():
                return last, False
        return self._read_network(texts, variables, seed), True

    def _texts(self, variables: Mapping[str, str]) -> list[str]:
        """Return the values that differ between networks, before any are drawn."""
        return [substitute(entry, variables).text for entry in self._varying]

    def _read_network(self, texts: list[str], variables: Mapping[str, str], seed: int) -> Network:
        settings = SettingReader(seed)
        entries = substituted(self._lines, variables)
        network = read_network(entries, settings, self._loader, self._hashes, self._instead, self._source)
        self._of_other_runs.append(network.lines_of_other_runs)
        self._read |= settings.lines_read()
        self._last = texts, seed, network
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

    def unread(self, variables: Sequence[IterationVariable]) -> tuple[UnreadVariables, ...]:
        """Return the variables that no run has read."""
        assert self._last is not None
        network = self._last[2]
        nodes = [spec.name for spec in network.fields["nodes"]]
        return tuple(
            UnreadVariables(line, names, line_instead(line, network.lookup, nodes))
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
            "communication_medium": CommunicationMediumSpec(
                **{field: float(setting.value) for field, setting in communication.items()}
            ),
            "reference_coordinates": (latitude, longitude, altitude),
            "obstacles": (*obstacles, *chain.from_iterable(obstacle_files.values())),
            "file_hashes": hashes.of(files, file_of_native(protocol.cls for protocol in chosen)),
        },
        lines_of_other_runs,
        lookup,
        settings,
    )


def _no_nodes(groups: Sequence[Group], instead: str, source: Source) -> ConfigError:
    for group in groups:  # each has a number of nodes, and it is 0
        if group.size_found is not None:
            size = group.size_found.entry.source
            return ConfigError.at(size, "there are no nodes", expected="at least one", hint=instead)
    return ConfigError("there are no nodes", source, expected="some, such as `*.numUavs = 2`", hint=instead)
