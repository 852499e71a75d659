"""What a configuration says, run by run: the plain data that both modes are built from."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from gradysim.config.errors.argument_names import OF_SCRIPT, ArgumentNames
from gradysim.config.errors.config_error import ConfigError
from gradysim.config.errors.source import Source
from gradysim.config.file.reader import Entry, Section, read_ini, read_overrides
from gradysim.config.file.sections import Ranked, search_order, what_to_run_instead
from gradysim.config.keys import NETWORK_KEYS
from gradysim.config.keys.key import Key
from gradysim.config.keys.options import LONGEST_RUN_S, NETWORK, OPTIONS
from gradysim.config.matching.groups import find_groups
from gradysim.config.matching.key_check import (
    NoSuchNodeError,
    ProtocolAndInterfaces,
    check_names,
    check_option,
    check_parameters,
)
from gradysim.config.matching.lookup import Lookup, is_ignored, is_option, network_name
from gradysim.config.matching.struct_reader import read_struct
from gradysim.config.node.interfaces import interface_counts
from gradysim.config.node.node_spec import NodeSpec
from gradysim.config.node.nodes import build_nodes, load_protocols
from gradysim.config.obstacle.obstacle_spec import ObstacleSpec
from gradysim.config.obstacle.obstacles import obstacle_count, obstacle_files, read_obstacles
from gradysim.config.protocol.loader import ProtocolLoader
from gradysim.config.runs.file_hashes import FileHashes
from gradysim.config.runs.iterations import name_iterations
from gradysim.config.runs.labels import free_text, with_labels
from gradysim.config.runs.numbered_runs import numbered_runs
from gradysim.config.runs.seed import check_seeds_of_runs, checked_seed, seed_of_file, whole_seed
from gradysim.config.runs.settings_hash import entries_of_the_hash, settings_hash
from gradysim.config.runs.unread_variables import UnreadVariables, line_instead, unread_variables
from gradysim.config.runs.variables import depends_on_run, run_variables, substitute
from gradysim.config.value.drawing_functions import drawing_function_in
from gradysim.config.value.setting import Setting, SettingReader, read_scalar
from gradysim.protocol.checked_values import checked_number
from gradysim.protocol.defaults import TRANSMISSION_RANGE_M


@dataclass(frozen=True)
class CommunicationMediumSpec:
    """Prototype mode's medium.

    Attributes:
        transmission_range_m: Distance up to which a message arrives.
        delay_s: Time from sending to arrival.
        failure_rate: Part of the messages that is lost, 0 to 1.
    """

    transmission_range_m: float = TRANSMISSION_RANGE_M
    delay_s: float = 0.0
    failure_rate: float = 0.0


@dataclass(frozen=True)
class Scenario:
    """One run of one configuration.

    Attributes:
        file: The .ini file.
        config: Name of the configuration.
        run_number: From 0, over all combinations of values that the configuration iterates over, and their
            repetitions.
        seed: Of all random streams of the run, 0 to 2^63 - 1. Those of values that the file draws are
            included: they are drawn when it is read, so that `replace(scenario, seed=...)` leaves them.
        description: What the configuration says of itself, or "".
        sim_time_limit_s: Simulated time at which the run ends.
        nodes: In the order of their ids.
        medium: Fields of MediumConfig that were set; the others keep their defaults.
        communication_medium: Prototype mode's medium.
        reference_coordinates: Latitude in degrees, longitude in degrees and altitude in metres of the origin.
        obstacles: What stands between the nodes.
        sections: The sections of the file that the configuration consists of, in the order of the search.
        repetition: 0 to repeat-1.
        iterations: Value of each iteration variable, `${x=1, 2}`, as a text.
        settings_hash: Of all that the file and the overrides say of this run, a seed given with them apart.
            It is the same for all repetitions, unless a variable is in lock-step with them.
        file_hashes: {name, seen from the folder of the .ini file: hash} of the files that settings name:
            protocols with what they import from their folder, obstacles, error rates.
        run_count: How many runs the configuration has, this one and those that were not asked for included.
        network: What paths of parameters and results begin with.
        lines: The entries of the overrides and of these sections in their order, with names for the values
            of this run.
        unread_variables: Those that the configuration iterates over and that no run reads; none if not all
            runs were asked for, as the others may.
    """

    file: Path
    config: str
    run_number: int
    seed: int
    description: str
    sim_time_limit_s: float
    nodes: tuple[NodeSpec, ...]
    medium: Mapping[str, Setting]
    communication_medium: CommunicationMediumSpec
    reference_coordinates: tuple[float, float, float]
    obstacles: tuple[ObstacleSpec, ...] = ()
    sections: tuple[Section, ...] = field(default=(), repr=False)
    repetition: int = 0
    iterations: Mapping[str, str] = field(default_factory=dict)
    settings_hash: str = ""
    file_hashes: Mapping[str, str] = field(default_factory=dict)
    run_count: int = 1
    network: str = "Network"
    lines: tuple[Entry, ...] = field(default=(), repr=False)
    unread_variables: tuple[UnreadVariables, ...] = field(default=(), repr=False)

    def __post_init__(self) -> None:
        """Check what scripts replace. Raises TypeError and ValueError, which name the field."""
        object.__setattr__(self, "seed", checked_seed(self.seed))
        limit_s = checked_number(
            "sim_time_limit_s",
            self.sim_time_limit_s,
            lambda time_s: 0 < time_s <= LONGEST_RUN_S,
            f"a number of seconds, more than 0 and at most {LONGEST_RUN_S}",
            ValueError,
        )
        object.__setattr__(self, "sim_time_limit_s", limit_s)
        for place, node in enumerate(self.nodes):
            if node.id != place:
                raise ValueError(
                    f"nodes: {node.name}, at place {place}, has the id {node.id}; expected 0, 1, ... in order"
                )

    @property
    def variables(self) -> dict[str, str]:
        """Value of each variable that `${...}` may name in this run, the predefined ones included."""
        values = run_variables(
            self.file, self.network, self.config, self.run_number, self.repetition, self.iterations
        )
        return with_labels(values, self.seed, _options(self.lines))

    @property
    def entries(self) -> tuple[Entry, ...]:
        """The lines with the values of this run."""
        variables = self.variables
        return tuple(line if is_ignored(line) else substitute(line, variables) for line in self.lines)


def require_scenario(value: object) -> None:
    """Raise TypeError if `value` is anything else, such as a file or the list of all runs."""
    if not isinstance(value, Scenario):
        raise TypeError(
            f"expected a Scenario, one of the list that load_scenarios returns, got {value!r:.80}"
        )


@dataclass(frozen=True)
class _Network:
    """The part of a scenario that is the same for all runs in which no value of it differs."""

    nodes: tuple[NodeSpec, ...]
    medium: Mapping[str, Setting]
    communication_medium: CommunicationMediumSpec
    reference_coordinates: tuple[float, float, float]
    obstacles: tuple[ObstacleSpec, ...]
    file_hashes: Mapping[str, str]
    lines_of_other_runs: Sequence[Source]
    """Those about nodes that this run has not, and others may have."""
    lookup: Lookup


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
        runs: Numbers of the runs that are wanted, or a text such as "0,2,5..9"; None for all.
        overrides: "KEY=VALUE" texts that come before all of the file; of several that match, the first.
        seed: Seed of run 0, to which run N adds N; None for the file's seed-set.
        names: What messages call these arguments.

    Returns:
        One scenario per run, by run number.

    Raises:
        ConfigError: Anything is wrong; nothing has been run.
        TypeError: `config` is no text, `overrides` are no list of texts, `runs` no numbers, or `seed` is no
            whole number.
    """
    if not isinstance(config, str):
        raise TypeError(f"{names.config} {config!r}: expected the name of a configuration")
    if seed is not None:
        seed = whole_seed(seed)
    file = Path(file)
    ini = read_ini(file)
    sections = search_order(ini, config)
    ranked = [Ranked(0, entry) for entry in read_overrides(file, overrides, names.overrides)]
    for rank, section in enumerate(sections, start=1):
        ranked += [Ranked(rank, entry) for entry in section.entries]
    for _, entry in ranked:
        if is_option(entry):
            check_option(entry)

    source = sections[0].source
    network_of_file = network_name(next((entry for _, entry in ranked if entry.key == NETWORK), None))
    ranked, variables = name_iterations(ranked)
    lines = tuple(entry for _, entry in ranked)
    only_options = [entry for entry in lines if is_option(entry)]
    as_written = _options(only_options)
    numbered, run_count = numbered_runs(as_written, variables, config, runs, source, names.runs)
    if seed is not None:
        check_seeds_of_runs(seed, max((number for number, _, _ in numbered), default=0), names.seed)

    loader, hashes = ProtocolLoader(), FileHashes(file.parent)
    parameters = [entry for _, entry in ranked if not is_option(entry) and not is_ignored(entry)]
    varying = [entry for entry in parameters if depends_on_run(entry)]
    always_draws = any(drawing_function_in(entry.text) for entry in parameters)
    instead = what_to_run_instead(ini, config, sections, names.config)
    in_force = entries_of_the_hash(ranked)
    elsewhere: list[Sequence[Source]] = []
    scenarios = []
    network: _Network | None = None  # that of the run before, kept while what it is made of stays the same
    made_of: tuple[str | int, ...] = ()
    read: set[Source] = set()
    hash_of_run = ""
    hash_is_of: Mapping[str, str] | None = None  # the iterations: no more of a run is in its hash
    for number, repetition, iterations in numbered:
        values = run_variables(file, network_of_file, config, number, repetition, iterations)
        of_file = seed_of_file(as_written, number, values)
        seed_of_run = of_file if seed is None else seed + number
        if iterations != hash_is_of:
            hashed = with_labels(values, seed_of_run, as_written, for_hash=True)
            hash_of_run, hash_is_of = settings_hash(_substituted(in_force, hashed)), iterations
        values = with_labels(values, seed_of_run, as_written)
        options = {key: substitute(entry, values) for key, entry in as_written.items()}
        texts = [substitute(entry, values).text for entry in varying]
        draws = always_draws or any(map(drawing_function_in, texts))
        alike = (*texts, *([seed_of_run] if draws else ()))
        if network is None or alike != made_of:
            settings = SettingReader(seed_of_run)
            network = _network(_substituted(ranked, values), settings, loader, hashes, instead, source)
            made_of = alike
            elsewhere.append(network.lines_of_other_runs)
            read |= settings.lines_read()
        scenario = _scenario(file, config, number, seed_of_run, options, network, sections)
        scenarios.append(
            replace(
                scenario,
                repetition=repetition,
                iterations=iterations,
                settings_hash=hash_of_run,
                run_count=run_count,
                network=network_of_file,
                lines=lines,
            )
        )
    if network is None or len(numbered) < run_count:  # the others may have those nodes, and read those lines
        return scenarios
    _check_lines_of_other_runs(elsewhere)
    nodes, ends = [spec.name for spec in network.nodes], settings.parameters_read()
    unread = tuple(
        UnreadVariables(line, names, line_instead(line, network.lookup, nodes, ends))
        for line, names in unread_variables(lines, variables, read).items()
    )
    return [replace(scenario, unread_variables=unread) for scenario in scenarios] if unread else scenarios


def _check_lines_of_other_runs(elsewhere: Sequence[Sequence[Source]]) -> None:
    """Raise NoSuchNodeError for the first line that each of the runs leaves to others."""
    for line in elsewhere[0]:
        if all(line in lines for lines in elsewhere):
            raise NoSuchNodeError(
                f"`{line.key}` matches no node in any run; expected a node that some run has", line
            )


def _scenario(
    file: Path,
    config: str,
    number: int,
    seed: int,
    options: Mapping[str, Entry],
    network: _Network,
    sections: list[Section],
) -> Scenario:
    sim_time_limit = options.get("sim-time-limit")
    if sim_time_limit is None:
        raise ConfigError(
            f"`{config}` does not say how long to simulate; expected `sim-time-limit = 1h`",
            sections[0].source,
        )
    description = options.get("description")
    return Scenario(
        file=file,
        config=config,
        run_number=number,
        seed=seed,
        description=free_text(description) if description else "",
        sim_time_limit_s=float(read_scalar(sim_time_limit, OPTIONS["sim-time-limit"])),
        nodes=network.nodes,
        medium=network.medium,
        communication_medium=network.communication_medium,
        reference_coordinates=network.reference_coordinates,
        obstacles=network.obstacles,
        file_hashes=network.file_hashes,
        sections=tuple(sections),
    )


def _substituted(ranked: list[Ranked], variables: Mapping[str, str]) -> list[Ranked]:
    return [
        Ranked(rank, entry if is_ignored(entry) else substitute(entry, variables)) for rank, entry in ranked
    ]


def _options(entries: Iterable[Entry]) -> dict[str, Entry]:
    """The entry in force for each option that is given and not left at its default."""
    options: dict[str, Entry] = {}
    for entry in entries:
        if entry.key in OPTIONS:
            options.setdefault(entry.key, entry)
    return {key: entry for key, entry in options.items() if entry.text != "default"}


def _network(
    ranked: list[Ranked],
    settings: SettingReader,
    loader: ProtocolLoader,
    hashes: FileHashes,
    instead: str,
    source: Source,
) -> _Network:
    lookup = Lookup(ranked)
    groups = find_groups(lookup, settings)
    try:
        lines_of_other_runs = check_names(lookup, groups)
    except NoSuchNodeError as error:
        raise NoSuchNodeError(error.message + instead, error.source) from None
    protocols = load_protocols(lookup, groups, settings, loader)
    if not protocols:
        for group in groups:  # each is given by the number of its nodes, and that is 0
            if group.size_found is not None:
                text = f"that is 0, and there are no nodes; expected one at least{instead}"
                raise ConfigError.at(group.size_found.entry.source, text)
        raise ConfigError(f"there are no nodes; expected some, such as `*.numUavs = 2`{instead}", source)
    counts = interface_counts(lookup, groups, settings)
    kinds = {name: ProtocolAndInterfaces(protocol.cls, counts[name]) for name, protocol in protocols.items()}
    check_parameters(lookup, groups, kinds, obstacle_count(lookup, settings))

    found = {
        key: entry for key in NETWORK_KEYS if (entry := lookup.first(*key.path.split(".", 1))) is not None
    }
    communication = read_struct("communication_medium", found, settings, _path_of)
    reference = read_struct("reference", found, settings, _path_of)
    latitude, longitude, altitude = (
        float(reference[field].value) if field in reference else 0.0
        for field in ("latitude_deg", "longitude_deg", "altitude_m")
    )
    nodes = build_nodes(lookup, groups, protocols, counts, settings)
    obstacles = read_obstacles(
        lookup,
        settings,
        (latitude, longitude, altitude) if {"latitude_deg", "longitude_deg"} <= reference.keys() else None,
    )
    files = [file for protocol in set(protocols.values()) for file in protocol.files]
    return _Network(
        nodes=nodes,
        medium=read_struct("medium", found, settings, _path_of),
        communication_medium=CommunicationMediumSpec(
            **{field: float(setting.value) for field, setting in communication.items()}
        ),
        reference_coordinates=(latitude, longitude, altitude),
        obstacles=obstacles,
        file_hashes=hashes.of([*files, *obstacle_files(lookup, settings), *settings.files()]),
        lines_of_other_runs=lines_of_other_runs,
        lookup=lookup,
    )


def _path_of(key: Key) -> str:
    """Of a parameter of the network."""
    return key.path
