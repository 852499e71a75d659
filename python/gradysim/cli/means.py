"""`gradysim means`: what many runs have in common."""

import shlex
import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.exit_code import OK, say_mistake


def print_means(
    directory: Annotated[Path, Parameter(name="DIR", help="The folder of `run --result-dir`.")],
    /,
    *quantities: Annotated[
        str,
        Parameter(
            name="QUANTITY",
            help="Which ones, by name, such as `uavs[*] heard` or `*delay*`: `*` is any letters, `?` any one;"
            " all by default.",
        ),
    ],
    as_csv: Annotated[
        bool, Parameter(name="--csv", negative="", help="As CSV, with all digits, for other programs.")
    ] = False,
) -> int:
    """Print means over runs, of the last values of tracked variables and of fates, with 95 % intervals."""
    from gradysim.cli.console import console
    from gradysim.cli.means_table import means_table, write_csv
    from gradysim.results.means import (
        has_files_for_omnetpp_alone,
        means,
        of_different_files,
        of_different_settings,
        read_results,
        repeated,
    )
    from gradysim.results.wanted_names import wanted
    from gradysim.scenario.errors import ConfigError, nearest

    quoted = shlex.quote(str(directory))
    try:
        if not directory.is_dir():
            reason = "it is no folder" if directory.exists() else "there is no such folder"
            raise ConfigError(f"{directory}: {reason}; expected that of `gradysim run FILE --result-dir DIR`")
        results = read_results(directory)
        if not results:
            are_others = has_files_for_omnetpp_alone(directory)
            reason = "it has only files for OMNeT++'s tools" if are_others else "it has no results"
            raise ConfigError(
                f"{directory}: {reason} of runs that came to their end; expected the JSON files of"
                f" `gradysim run FILE --result-dir {quoted}`"
            )
        found = means(results)
        names = dict.fromkeys(mean.quantity for mean in found)
        for quantity in quantities:
            if not any(map(wanted(quantity), names)):
                raise ConfigError(
                    f"{directory}: no quantity is called `{quantity}`",
                    expected=f"one that `gradysim means {quoted}` prints",
                    suggestion=nearest(quantity, names),
                )
    except (ConfigError, OSError) as mistake:
        return say_mistake(mistake)
    if (two := of_different_settings(results)) is not None:
        print(
            f"{directory}: warning: {two[0]} and {two[1]} are of different settings (`settings_hash`), and"
            " their mean is one of both; expected a folder for each",
            file=sys.stderr,
        )
    elif (of_files := of_different_files(results)) is not None:
        print(
            f"{directory}: warning: {of_files[2]} changed between {of_files[0]} and {of_files[1]}"
            " (`file_hashes`), so that they cannot be compared; expected one version of it, as"
            f" `gradysim run FILE --result-dir {quoted} --resume` makes",
            file=sys.stderr,
        )
    if repetitions := repeated(results):
        one, another = repetitions[0]
        print(
            f"{directory}: warning: {len(repetitions)} of {len(results)} runs are another one over again,"
            f" with its seed and its results, as {another} is {one}: they count as if they were independent,"
            " which makes the intervals too narrow; expected a seed for each, as `seed-set = ${runnumber}`,"
            " the default, gives them",
            file=sys.stderr,
        )
    fits = wanted(quantities or None)
    found = [mean for mean in found if fits(mean.quantity)]
    if as_csv:
        write_csv(found, sys.stdout)
    else:
        console().print(means_table(found))
    return OK
