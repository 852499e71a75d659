"""The runs of a configuration: read for the commands, listed by `gradysim runs`, and warnings about them."""

import contextlib
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from gradysim.cli.errors import OK, report_error
from gradysim.cli.options import ConfigOption, FileArgument, SetOption
from gradysim.integrated.ranges import lint_ranges
from gradysim.scenario.errors import ArgumentNames, ConfigError
from gradysim.scenario.lint import Finding, by_line, lint, unread_variables
from gradysim.scenario.load import Study, runs_of
from gradysim.scenario.parse.ini import Entry, read_overrides
from gradysim.scenario.resolve.sweep import text_of_iterations
from gradysim.scenario.scenario import Scenario


def list_runs(file: FileArgument, /, *, config: ConfigOption = "General", settings: SetOption = ()) -> int:
    """Carry out `gradysim runs`, and return the exit code."""
    try:
        for number, repetition, iterations in runs_of(file, config, settings):
            print(f"Run {number}: {text_of_iterations({**iterations, 'repetition': repetition})}")
    except ConfigError as error:
        return report_error(error)
    with contextlib.suppress(ConfigError):  # `gradysim check` reports it
        first = check(file, config, None, settings)[0]
        print_warnings(unread_variables(first.unread_variables, first.lines))
    return OK


def check(
    file: Path,
    config: str,
    runs: str | None,
    settings: Sequence[str],
    seed: int | None = None,
    part: slice = slice(None),
) -> Study:
    """Return the runs of a configuration, or a part of them, checked. Raises ConfigError.

    Prints to standard error which of `settings` have no effect because an earlier one has the same key.
    """
    names = ArgumentNames(overrides="--set", seed="--seed", runs="-r", config="-c")
    _warn_of_repeated(settings, file, names.overrides)
    with contextlib.chdir("."):  # files of protocols run, and may change the directory
        return Study(file, config, runs, settings, seed, names, part)


def _warn_of_repeated(settings: Sequence[str], file: Path, option: str) -> None:
    first: dict[str, Entry] = {}
    for entry in read_overrides(file, settings, option):
        above = first.setdefault(entry.key, entry)
        if above.text != entry.text:
            print(
                f"{entry.source}: warning: `{entry.key}` has no effect: `{above.source}` says the same thing"
                " and comes first; expected one of them",
                file=sys.stderr,
            )


def print_warnings(warnings: Iterable[str | Finding]) -> None:
    """Print each warning to standard error."""
    for warning in warnings:
        print(warning, file=sys.stderr)


def warnings_of_seeds(study: Study) -> Iterator[str]:
    """Yield a line if runs share a seed, all else being equal."""
    if study.has_equal_runs():
        first = study.seeds[0]
        same = f"seed {first}" if all(seed == first for seed in study.seeds) else "only a few different seeds"
        yield (
            f"warning: the {len(study)} runs of {study.config} have {same}: runs with one seed are"
            " identical if nothing else depends on ${runnumber}; `seed-set = ${runnumber}` is the default"
        )


def findings_of(scenarios: Sequence[Scenario], mode: str) -> list[Finding]:
    """Return the lint findings in the lines of a configuration, in their order."""
    findings = lint(scenarios)
    if mode == "integrated":
        from gradysim.integrated.network_lint import lint_networks

        findings += lint_networks(scenarios)
    findings += lint_ranges(scenarios, mode)
    return by_line(findings)
