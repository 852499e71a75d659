"""Values, patterns, iteration variables and configurations of .ini files, against OMNeT++."""

import math
import re
from collections.abc import Callable
from pathlib import Path

from gradysim.scenario.parse.expressions import ParameterContext, parse_value
from gradysim.scenario.parse.functions import Value
from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.patterns import compile_pattern
from gradysim.scenario.parse.sections import entries_in_order, search_order
from gradysim.scenario.parse.units import Quantity
from gradysim.scenario.resolve.runs import numbered_runs
from gradysim.scenario.resolve.sweep import name_iterations, run_variables, substitute, text_of_iterations
from gradysim.scenario.schema.options import is_option
from verification.finding import Finding
from verification.reference_data import rows

PATH = "e[2].leaf.v"
"""Parameter that has the values in OMNeT++."""

SIX_DIGITS = 2e-5
"""Relative tolerance: OMNeT++ writes that many digits."""


def is_equal(ours: Value, theirs: str) -> bool:
    """Return whether OMNeT++ writes the value like this."""
    if not isinstance(ours, Quantity):
        return theirs == (f'"{ours}"' if isinstance(ours, str) else str(ours).lower())
    written = parse_value(theirs)
    assert isinstance(written, Quantity)
    return math.isclose(*written.numbers_beside(ours), rel_tol=SIX_DIGITS, abs_tol=1e-12)


def test_expressions_have_omnetpps_values(report: Callable[[Finding], None]) -> None:
    table = rows("omnetpp_expressions")
    differing = [
        row["expression"]
        for row in table
        if not is_equal(parse_value(row["expression"], ParameterContext(0, PATH)), row["value"])
    ]
    report(
        Finding(
            "values of .ini files: random expressions of numbers, quantities, texts, truths, against OMNeT++",
            f"{len(differing)} of {len(table)} differ {', '.join(differing[:3])}".strip(),
            "0",
            "nothing is random; numbers are compared to the six digits that OMNeT++ writes",
            not differing,
        )
    )


def test_patterns_match_what_they_match_in_omnetpp(report: Callable[[Finding], None]) -> None:
    table = rows("omnetpp_patterns")
    differing = [
        f"{row['text']} =~ {row['pattern']}"
        for row in table
        if compile_pattern(row["pattern"]).matches(row["text"]) != (row["matches"] == "true")
    ]
    report(
        Finding(
            "patterns of keys in .ini files: random texts and patterns, against OMNeT++",
            f"{len(differing)} of {len(table)} differ {', '.join(differing[:3])}".strip(),
            "0",
            "nothing is random; about half of them match",
            not differing,
        )
    )


def runs_of(file: Path, config: str) -> tuple[list[set[str]], set[str]]:
    """Return the iteration variables of each run, and the lines of the last one."""
    sections = search_order(read_ini(file), config)
    entries, variables = name_iterations(entries_in_order((), sections))
    options = {entry.key: entry for entry in reversed(entries) if is_option(entry)}
    numbered = numbered_runs(options, variables, config, None, sections[0].source, "runs")
    last = run_variables(file, "Network", config, *numbered[-1])
    return (
        [
            variables_in(text_of_iterations({**run.iterations, "repetition": run.repetition}))
            for run in numbered
        ],
        {f"{entry.key} = {substitute(entry, last).text}" for entry in entries if not is_option(entry)},
    )


def variables_in(text: str) -> set[str]:
    """Return the parts of `$x=1, $repetition=0`."""
    return set(re.split(r", (?=\$)", text))


def test_configurations_have_omnetpps_runs(report: Callable[[Finding], None], tmp_path: Path) -> None:
    table = rows("omnetpp_runs")
    differing = []
    count = 0
    for number, row in enumerate(table):
        file = tmp_path / f"{number}.ini"
        file.write_text(row["file"], encoding="utf-8")
        runs, lines = runs_of(file, row["config"])
        count += len(runs)
        wanted = [variables_in(line) for line in row["runs"].splitlines()]
        if runs != wanted or not set(row["last_run"].splitlines()) <= lines:
            differing.append(f"{row['file']!r} {row['config']}")
    report(
        Finding(
            "configurations of .ini files: sections that extend each other, iteration variables, lock-step, "
            "constraints, repetitions and nesting order in random files, against OMNeT++",
            f"the runs of {len(differing)} of {len(table)} files differ {', '.join(differing[:1])}".strip()
            + f"; {count} runs",
            "0",
            "nothing is random: each run has a number and values",
            not differing,
        )
    )
