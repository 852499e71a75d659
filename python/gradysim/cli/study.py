"""The directory of a study, and the runs in it, for commands that read them."""

import gc
import shlex
import sys
from collections.abc import Iterable
from pathlib import Path

from gradysim.encapsulator.run_context import gc_paused
from gradysim.results.means import of_different_files, of_different_settings, repeated
from gradysim.results.quantity import name_filter
from gradysim.results.result_dir import has_files_for_omnetpp_alone
from gradysim.results.run_table import Runs, runs
from gradysim.scenario.errors import ConfigError, nearest


def read_study(directory: Path) -> Runs:
    """Return the runs in a directory or in a pack, at least one.

    Raises ConfigError and OSError.
    """
    if not directory.is_file():
        check_directory(directory)
    with gc_paused():
        found = runs(directory)
    gc.freeze()  # no search for garbage in up to 100,000 summaries
    if not len(found):
        reason = "no results" if not has_files_for_omnetpp_alone(directory) else "only .sca and .vec files"
        raise ConfigError(
            f"{directory}: it has {reason} of complete runs; expected the JSON files of"
            f" `gradysim run FILE --result-dir {shlex.quote(str(directory))}`"
        )
    return found


def drawn_text(files: Iterable[Path]) -> str:
    """Return what the commands print about the three files of a figure."""
    return "drawn in {}; numbers in {}, origin in {}".format(*files)


def conditions(where: Iterable[str]) -> dict[str, list[str]]:
    """Return {variable: values} of `--where`. Raises ConfigError."""
    wanted: dict[str, list[str]] = {}
    for condition in where:
        variable, equals, value = condition.partition("=")
        if not equals:
            raise ConfigError(f"--where {condition}: expected VARIABLE=VALUE")
        wanted.setdefault(variable, []).append(value)
    return wanted


def check_quantities(
    wanted: Iterable[str], found: Iterable[str], directory: Path, known: Iterable[str]
) -> None:
    """Raise ConfigError for a name that selects none of the `found` quantities.

    `known` are all quantities of the runs in the directory.
    """
    names = list(found)
    for quantity in wanted:
        if not any(map(name_filter(quantity), names)):
            raise ConfigError(
                f"{directory}: no quantity is called `{quantity}`",
                expected=f"one that `gradysim means {shlex.quote(str(directory))}` prints",
                suggestion=nearest(quantity, known),
            )


def check_directory(directory: Path) -> None:
    """Raise ConfigError if there is no such directory."""
    if not directory.is_dir():
        reason = "it is not a directory" if directory.exists() else "there is no such directory"
        raise ConfigError(f"{directory}: {reason}; expected that of `gradysim run FILE --result-dir DIR`")


def warn_of_mixed_runs(directory: Path, results: Runs) -> None:
    """Warn of runs that should not be averaged: of other settings or files, and the same run twice."""
    if (pair := of_different_settings(results)) is not None:
        print(
            f"{directory}: warning: {pair[0]} and {pair[1]} have different settings (`settings_hash`), and"
            " their mean mixes both; expected a directory for each",
            file=sys.stderr,
        )
    elif (changed := of_different_files(results)) is not None:
        print(
            f"{directory}: warning: {changed[2]} changed between {changed[0]} and {changed[1]}"
            " (`file_hashes`), so they cannot be compared; expected one version of it: run"
            f" `gradysim run FILE --result-dir {shlex.quote(str(directory))} --resume`",
            file=sys.stderr,
        )
    if repetitions := repeated(results):
        original, repetition = repetitions[0]
        print(
            f"{directory}: warning: {len(repetitions)} of {len(results)} runs repeat another one with the"
            f" same seed and results, such as {repetition} and {original}: the intervals are too narrow;"
            " expected a seed for each, as `seed-set = ${runnumber}`, the default, sets it",
            file=sys.stderr,
        )
