"""Reads a configuration of a file as scenarios, one for each run."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from gradysim.scenario.errors.argument_names import OF_SCRIPT, ArgumentNames
from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.reader import Entry, read_ini, read_overrides
from gradysim.scenario.file.sections import Ranked, search_order, what_to_run_instead
from gradysim.scenario.matching.key_check import check_option
from gradysim.scenario.matching.lookup import is_option, network_name, options_in_force
from gradysim.scenario.network import Network
from gradysim.scenario.networks import Networks
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
        seed: Seed of run 0, to which run N adds N, each 0 to 2^63 - 1; None for the file's seed-set.
        names: What messages call these arguments.

    Returns:
        One scenario per run, by run number.

    Raises:
        ConfigError: Anything is wrong; nothing has been run.
        TypeError: `config` is no text, `overrides` are no list of texts, `runs` no numbers, or `seed` is no
            whole number.
    """
    checked = CheckedScenarios(file, config, runs, overrides, seed, names)
    return [checked.placed(scenario) for scenario in checked.scenarios]


class CheckedScenarios:
    """The runs of a configuration, all of it checked, of which only what is asked for is worked out.

    Attributes:
        scenarios: One per run, by run number. Of those that differ in their seeds alone, nodes may stand
            where they do in the first of them; `placed` puts them where they belong.
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
        for _, entry in ranked:
            if is_option(entry):
                check_option(entry)

        network_of_file = network_name(next((entry for _, entry in ranked if entry.key == NETWORK), None))
        ranked, variables = name_iterations(ranked)
        lines = tuple(entry for _, entry in ranked)
        as_written = options_in_force(lines)
        numbered, run_count = numbered_runs(as_written, variables, config, runs, source, names.runs)
        if seed is not None:
            check_seeds_of_runs(seed, max((number for number, _, _ in numbered), default=0), names.seed)

        instead = what_to_run_instead(ini, config, sections, names.config)
        networks = self._networks = Networks(ranked, file.parent, instead, source)
        self._elsewhere: dict[int, dict[str, str]] = {}  # variables of runs with a network of another seed
        in_force = entries_of_the_hash(ranked)
        hashes: dict[tuple[str, ...], str] = {}  # by the values of the iterations: no more of a run is in it
        made = []
        for number, repetition, iterations in numbered:
            values = run_variables(file, network_of_file, config, number, repetition, iterations)
            of_file = seed_of_file(as_written, number, values)
            seed_of_run = of_file if seed is None else seed + number
            key = tuple(iterations.values())
            if key not in hashes:
                hashed = with_labels(values, seed_of_run, as_written, for_hash=True)
                hashes[key] = settings_hash(substituted(in_force, hashed))
            values = with_labels(values, seed_of_run, as_written)
            options = {name: substitute(entry, values) for name, entry in as_written.items()}
            network, is_its_own = networks.checked(values, seed_of_run)
            if not is_its_own:
                self._elsewhere[number] = values
            made.append(
                partial(
                    Scenario,
                    file=file,
                    config=config,
                    run_number=number,
                    seed=seed_of_run,
                    description=_description(options),
                    sim_time_limit_s=_sim_time_limit_s(options, config, source),
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
        if len(numbered) < run_count:  # the others may have nodes that these have not, and read other lines
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
    """Those that a scenario has of its network."""
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
        raise ConfigError(
            f"`{config}` does not say how long to simulate; expected `sim-time-limit = 1h`", source
        )
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
