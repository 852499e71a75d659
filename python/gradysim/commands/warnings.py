"""What is told before runs that go on all the same."""

import sys
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gradysim.config.node.node_spec import NodeSpec
    from gradysim.config.scenario import Scenario


def warn_of_equal_seeds(scenarios: "Sequence[Scenario]") -> None:
    """Say on the error output that runs share a seed, all else being equal."""
    seeds = {scenario.seed for scenario in scenarios}
    different = {(scenario.seed, *scenario.iterations.values()) for scenario in scenarios}
    if len(different) < len(scenarios):
        same = f"seed {seeds.pop()}" if len(seeds) == 1 else "only a few different seeds"
        print(
            f"warning: the {len(scenarios)} runs of {scenarios[0].config} have {same}: runs with one seed are"
            " identical if nothing else depends on ${runnumber}; `seed-set = ${runnumber}` is the default",
            file=sys.stderr,
        )


def warn_of_shadowed_lines(scenario: "Scenario") -> None:
    """Say on the error output which lines of its file have no effect, because of others above them."""
    from gradysim.config.doubts.shadowed_lines import shadowed_lines
    from gradysim.config.keys.radio_media import RADIO_MEDIA

    medium = scenario.medium.get("typename")
    has_powers = medium is None or medium.value in RADIO_MEDIA.names
    for text in shadowed_lines(scenario.sections, has_powers=has_powers):
        print(text, file=sys.stderr)


def warn_of_unread_variables(scenario: "Scenario") -> None:
    """Say on the error output which variables its configuration iterates over in vain."""
    from gradysim.config.doubts.unread_variables import unread_variables

    for text in unread_variables(scenario.unread_variables, scenario.lines):
        print(text, file=sys.stderr)


def warn_of_doubtful_times(scenarios: "Sequence[Scenario]") -> None:
    """Say on the error output, once for all runs, which times of protocols are given as something else."""
    from gradysim.config.doubts.doubtful_times import doubtful_times

    _tell_of_nodes(scenarios, doubtful_times)


def warn_of_mission_speeds(scenarios: "Sequence[Scenario]") -> None:
    """Say on the error output, once for all runs, which speeds missions override by their default."""
    from gradysim.config.doubts.mission_speeds import mission_speeds

    _tell_of_nodes(scenarios, mission_speeds)


def warn_of_plugins_without_telemetry(scenarios: "Sequence[Scenario]") -> None:
    """Say on the error output, once for all runs, which missions and trips lack the telemetry for it."""
    from gradysim.config.doubts.plugins_without_telemetry import plugins_without_telemetry

    _tell_of_nodes(scenarios, plugins_without_telemetry)


def warn_of_bands_beside_frequencies(scenarios: "Sequence[Scenario]") -> None:
    """Say on the error output, once for all runs, which bands say nothing, as frequencies are given."""
    from gradysim.config.doubts.bands_beside_frequencies import bands_beside_frequencies

    _tell_of_nodes(scenarios, bands_beside_frequencies)


def _tell_of_nodes(
    scenarios: "Sequence[Scenario]", texts_of: "Callable[[Sequence[NodeSpec]], Iterable[str]]"
) -> None:
    networks = {id(scenario.nodes): scenario.nodes for scenario in scenarios}
    for text in dict.fromkeys(text for nodes in networks.values() for text in texts_of(nodes)):
        print(text, file=sys.stderr)


def warn_of_what_is_seldom_meant(scenarios: "Sequence[Scenario]") -> None:
    """Say on the error output, once for all runs, which lines nothing reads, and the like."""
    from gradysim.integrated.scenario_warnings import scenario_warnings

    different = {(id(scenario.nodes), id(scenario.medium)): scenario for scenario in scenarios}
    for text in dict.fromkeys(
        text for scenario in different.values() for text in scenario_warnings(scenario)
    ):
        print(text, file=sys.stderr)
