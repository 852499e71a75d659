"""Warnings of `gradysim run`. They do not stop it."""

import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gradysim.scenario.lint import Finding
    from gradysim.scenario.scenario import Scenario


def tell(warnings: "Iterable[str | Finding]") -> None:
    """Print each of them to the error output."""
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


def findings_of(scenarios: "Sequence[Scenario]", mode: str) -> "list[Finding]":
    """Return what the lint checks find in the lines of a configuration, in their order."""
    from gradysim.scenario.lint import by_line, lint

    findings = lint(scenarios)
    if mode == "integrated":
        from gradysim.integrated.lint import lint_networks

        findings += lint_networks(scenarios)
    return by_line(findings)
