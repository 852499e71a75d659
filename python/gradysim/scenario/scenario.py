"""Scenarios as plain data, one for each run. Both modes are built from them."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gradysim.notebook import html_table
from gradysim.protocol.checked_values import checked_number
from gradysim.scenario.errors import ConfigError, Source, nearest
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.obstacle_spec import ObstacleSpec
from gradysim.scenario.parse.ini import Entry, Section
from gradysim.scenario.resolve.resolution import Resolution
from gradysim.scenario.resolve.runs import UnreadVariables, checked_seed
from gradysim.scenario.resolve.sweep import run_variables, substitute, with_labels
from gradysim.scenario.schema.options import LONGEST_RUN_S, is_ignored, options_in_force
from gradysim.scenario.schema.values import Setting


@dataclass(frozen=True)
class CommunicationMediumSpec:
    """Prototype mode's medium.

    Attributes:
        transmission_range_m: Distance up to which a message arrives, >= 0. None: that of each node's radio.
        delay_s: Time from sending to arrival, >= 0.
        failure_rate: Ratio of lost messages, 0 to 1.
        range_source: The source of the range, if the file gives one.
    """

    transmission_range_m: float | None = None
    delay_s: float = 0.0
    failure_rate: float = 0.0
    range_source: Source | None = None


@dataclass(frozen=True)
class Scenario:
    """One run of one configuration.

    Attributes:
        file: The .ini file.
        config: Name of the configuration.
        run_number: From 0, over all combinations of iteration variables and their repetitions.
        seed: Seed of all random streams of the run, 0 to 2^63 - 1. Values that the file draws are drawn when
            it is read, so `replace(scenario, seed=...)` does not change them.
        description: The description of the configuration, or "".
        sim_time_limit_s: Simulated time at which the run ends, > 0 and at most 9,200,000.
        nodes: In the order of their ids.
        medium: Fields of MediumConfig that were set; the others keep their defaults.
        communication_medium: Prototype mode's medium.
        reference_coordinates: Latitude in degrees, longitude in degrees and altitude in meters of the origin.
        obstacles: Obstacles between the nodes.
        wind: Fields of WindConfig that were set, in SI units.
        sections: The sections of the configuration, in search order.
        repetition: 0 to repeat-1.
        iterations: Value of each iteration variable, `${x=1, 2}`, as a string.
        settings_hash: Hash of the settings of this run in the file and the overrides, without the argument
            `seed`. All repetitions have the same hash, unless a variable is in lock-step with them.
        file_hashes: {name relative to the directory of the .ini file: hash} of the files that settings name:
            protocols with the files that they import from their directory, obstacles, error rates.
        run_count: Number of runs of the configuration, including those that were not requested.
        network: The first name of paths of parameters and results.
        vector_record_interval_s: Least time between two rows of a vector.
        lines: The entries of the overrides and of the sections in their order, with variables.
        unread_variables: Iteration variables that no run reads; empty if not all runs were requested.
        resolution: Which line sets which parameter. None for a scenario from another process.
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
    wind: Mapping[str, float] = field(default_factory=dict)
    sections: tuple[Section, ...] = field(default=(), repr=False)
    repetition: int = 0
    iterations: Mapping[str, str] = field(default_factory=dict)
    settings_hash: str = ""
    file_hashes: Mapping[str, str] = field(default_factory=dict)
    run_count: int = 1
    network: str = "Network"
    vector_record_interval_s: float = 0.0
    lines: tuple[Entry, ...] = field(default=(), repr=False)
    unread_variables: tuple[UnreadVariables, ...] = field(default=(), repr=False)
    resolution: Resolution | None = field(default=None, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Check values that scripts may replace. Raises TypeError and ValueError, which name the field."""
        object.__setattr__(self, "seed", checked_seed(self.seed))
        limit_s = self.sim_time_limit_s
        limit_s = checked_number("sim_time_limit_s", limit_s, 0, LONGEST_RUN_S, above=True, unit="s")
        object.__setattr__(self, "sim_time_limit_s", limit_s)
        for index, node in enumerate(self.nodes):
            if node.id != index:
                raise ValueError(
                    f"nodes: {node.name}, at index {index}, has the id {node.id}; expected 0, 1, ... in order"
                )

    def __getstate__(self) -> dict[str, Any]:
        """Support pickle: other processes run the scenario, and do not explain it."""
        return vars(self) | {"resolution": None}

    def _repr_html_(self) -> str:
        """Return the groups of nodes as a table, for notebooks."""
        groups = dict.fromkeys((node.group, node.protocol.__name__) for node in self.nodes)
        counts = Counter((node.group, node.protocol.__name__) for node in self.nodes)
        values = "".join(f", {name} = {value}" for name, value in self.iterations.items())
        about = f"{self.file.name}, {self.config} run {self.run_number}{values}, seed {self.seed}"
        return html_table(
            f"{about}, {self.sim_time_limit_s:g} s",
            ("nodes", "protocol", "count"),
            [(group, protocol, counts[group, protocol]) for group, protocol in groups],
        )

    @property
    def variables(self) -> dict[str, str]:
        """Value of each variable of this run, including the predefined ones."""
        values = run_variables(
            self.file, self.network, self.config, self.run_number, self.repetition, self.iterations
        )
        return with_labels(values, self.seed, options_in_force(self.lines))

    @property
    def entries(self) -> tuple[Entry, ...]:
        """The lines with the values of this run instead of variables."""
        variables = self.variables
        return tuple(line if is_ignored(line) else substitute(line, variables) for line in self.lines)


def require_scenario(value: object) -> None:
    """Raise TypeError if `value` is not a Scenario but, for example, the list of all runs."""
    if not isinstance(value, Scenario):
        raise TypeError(
            f"expected a Scenario, one of the list that load_scenarios returns, got {value!r:.80}"
        )


ALL = "all"
"""Stands for every node, unless a node or a group has that name."""


def nodes_named(scenario: Scenario, names: Iterable[str]) -> list[NodeSpec]:
    """Return the nodes with these names, each once, in the order of ids. Unknown names are ignored.

    `names` are those of nodes (`uavs[0]`), of groups (`uavs`), or `ALL`.
    """
    chosen = {node.id: node for name in names for node in _nodes_of(scenario, name)}
    return [chosen[node_id] for node_id in sorted(chosen)]


def check_node_names(
    scenarios: Sequence[Scenario], names: Iterable[str], option: str, run_count: int
) -> None:
    """Raise ConfigError for the first name that exists in none of these runs of a configuration.

    `option` is the option that has the names, `--pcap`. The scenarios stand for `run_count` runs.
    """
    networks = list({id(scenario.nodes): scenario for scenario in scenarios}.values())
    for name in names:
        if not any(_nodes_of(scenario, name) for scenario in networks):
            raise _no_such_node(scenarios, name, option, run_count)


def _nodes_of(scenario: Scenario, name: str) -> Sequence[NodeSpec]:
    found = [node for node in scenario.nodes if name in (node.name, node.group)]
    return scenario.nodes if name == ALL and not found else found


def _no_such_node(scenarios: Sequence[Scenario], name: str, option: str, run_count: int) -> ConfigError:
    nodes = {node.name: node for scenario in scenarios for node in scenario.nodes}
    if not nodes:
        return ConfigError(f"{option} {name}: no such node; the scenario has none")
    groups = list(dict.fromkeys(node.group for node in nodes.values()))
    where = ""
    if run_count > 1:
        where = " in any of the runs"
    elif scenarios[0].run_count > 1:  # others may have it
        where = f" in run {scenarios[0].run_number}"
    return ConfigError(
        f"{option} {name}: no such node{where}",
        expected=f"a node such as {next(iter(nodes))}, a group ({', '.join(groups)}) or {ALL}",
        suggestion=nearest(name, [*groups, *nodes, ALL]),
    )
