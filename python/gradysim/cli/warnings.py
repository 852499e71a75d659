"""What is told before runs that go on all the same."""

import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gradysim.scenario.scenario import Scenario


def tell(warnings: Iterable[str]) -> None:
    """Say each of them on the error output."""
    for warning in warnings:
        print(warning, file=sys.stderr)


def warnings_of_seeds(scenarios: "Sequence[Scenario]") -> Iterator[str]:
    """Yield a line if runs share a seed, all else being equal."""
    seeds = {scenario.seed for scenario in scenarios}
    different = {(scenario.seed, *scenario.iterations.values()) for scenario in scenarios}
    if len(different) < len(scenarios):
        same = f"seed {seeds.pop()}" if len(seeds) == 1 else "only a few different seeds"
        yield (
            f"warning: the {len(scenarios)} runs of {scenarios[0].config} have {same}: runs with one seed are"
            " identical if nothing else depends on ${runnumber}; `seed-set = ${runnumber}` is the default"
        )


def warnings_of_lines(scenarios: "Sequence[Scenario]") -> Iterator[str]:
    """Yield a line for each line of the file that is probably not meant so, once for all runs."""
    from gradysim.scenario.doubts.bands_beside_frequencies import bands_beside_frequencies
    from gradysim.scenario.doubts.doubtful_times import doubtful_times
    from gradysim.scenario.doubts.mission_speeds import mission_speeds
    from gradysim.scenario.doubts.overwritten_parameters import overwritten_parameters
    from gradysim.scenario.doubts.plugins_without_telemetry import plugins_without_telemetry
    from gradysim.scenario.doubts.shadowed_lines import shadowed_lines
    from gradysim.scenario.doubts.shared_containers import shared_containers
    from gradysim.scenario.doubts.unread_variables import unread_variables
    from gradysim.scenario.keys import has_radios

    first = scenarios[0]
    medium = first.medium.get("typename")
    has_powers = medium is None or has_radios(medium.value)
    yield from shadowed_lines(first.sections, has_powers=has_powers)
    yield from unread_variables(first.unread_variables, first.lines)
    networks = {id(scenario.nodes): scenario.nodes for scenario in scenarios}.values()
    about_nodes = (
        bands_beside_frequencies,
        doubtful_times,
        mission_speeds,
        overwritten_parameters,
        plugins_without_telemetry,
        shared_containers,
    )
    for doubts in about_nodes:
        yield from dict.fromkeys(text for nodes in networks for text in doubts(nodes))


def warnings_of_networks(scenarios: "Sequence[Scenario]") -> Iterator[str]:
    """Yield a line for each line that no model reads, and the like, once for all runs of integrated mode."""
    from gradysim.integrated.scenario_warnings import scenario_warnings

    different = {(id(scenario.nodes), id(scenario.medium)): scenario for scenario in scenarios}
    yield from scenario_warnings(different.values())
