"""Reads a configuration of a file as scenarios, one for each run."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from gradysim.scenario.errors import OF_SCRIPT, ArgumentNames, ConfigError, ErrorCollector, Source
from gradysim.scenario.ini import Entry, Ranked, read_ini, read_overrides, search_order, what_to_run_instead
from gradysim.scenario.lookup import is_option, network_name, options_in_force
from gradysim.scenario.network import Network, Networks
from gradysim.scenario.options import NETWORK, OPTIONS
from gradysim.scenario.runs import (
    check_seeds_of_runs,
    entries_of_the_hash,
    numbered_runs,
    seed_of_file,
    settings_hash,
    whole_seed,
)
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.settings import read_scalar
from gradysim.scenario.sweep import (
    free_text,
    name_iterations,
    run_variables,
    substitute,
    substituted,
    with_labels,
)
from gradysim.scenario.unknown_keys import check_option

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
        ranked = [Ranked(0, entry) for entry in read_overrides(file, overrides, names.overrides)]
        for rank, section in enumerate(sections, start=1):
            ranked += [Ranked(rank, entry) for entry in section.entries]
        errors = ErrorCollector()
        for _, entry in ranked:
            if is_option(entry):
                with errors.collecting():
                    check_option(entry)
        try:
            network_of_file = network_name(next((entry for _, entry in ranked if entry.key == NETWORK), None))
            ranked, variables = name_iterations(ranked)
            lines = tuple(entry for _, entry in ranked)
            as_written = options_in_force(lines)
            numbered, run_count = numbered_runs(as_written, variables, config, runs, source, names.runs)
            if seed is not None:
                check_seeds_of_runs(seed, max((number for number, _, _ in numbered), default=0), names.seed)
        except ConfigError as error:  # without runs there is nothing else to check
            errors.add(error)
            raise errors.combined() from None

        instead = what_to_run_instead(ini, config, sections, names.config)
        networks = self._networks = Networks(ranked, file.parent, instead, source)
        self._elsewhere: dict[int, dict[str, str]] = {}  # variables of runs with a network of another seed
        in_force = entries_of_the_hash(ranked)
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
                    **_fields(network),
                    sections=sections,
                    repetition=repetition,
                    iterations=iterations,
                    settings_hash=hashes[key],
                    run_count=run_count,
                    network=network_of_file,
                    lines=lines,
                )
            )
        errors.raise_all()
        if len(numbered) < run_count:  # the other runs may have more nodes, and read other lines
            self.scenarios = [make() for make in made]
            return
        networks.check_lines_of_other_runs()
        unread = networks.unread(lines, variables)
        self.scenarios = [make(unread_variables=unread) for make in made]

    def placed(self, scenario: Scenario) -> Scenario:
        """Return one of the scenarios with its nodes where they are."""
        variables = self._elsewhere.get(scenario.run_number)
        if variables is None:
            return scenario
        return replace(scenario, **_fields(self._networks.of_run(variables, scenario.seed)))


def _fields(network: Network) -> dict[str, Any]:
    """Return the fields of a scenario that come from its network."""
    return {
        "nodes": network.nodes,
        "medium": network.medium,
        "communication_medium": network.communication_medium,
        "reference_coordinates": network.reference_coordinates,
        "obstacles": network.obstacles,
        "file_hashes": network.file_hashes,
    }


def _sim_time_limit_s(options: Mapping[str, Entry], config: str, source: Source) -> float:
    limit = options.get("sim-time-limit")
    if limit is None:
        raise ConfigError(f"`{config}` has no time limit", source, expected="`sim-time-limit = 1h`")
    return float(read_scalar(limit, OPTIONS["sim-time-limit"]))


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
    ranked = [Ranked(0, entry) for entry in read_overrides(Path(file), overrides, names.overrides)]
    for rank, section in enumerate(sections, start=1):
        ranked += [Ranked(rank, entry) for entry in section.entries]
    ranked, variables = name_iterations(ranked)
    as_written = options_in_force(tuple(entry for _, entry in ranked))
    return numbered_runs(as_written, variables, config, None, sections[0].source, names.runs)[0]
