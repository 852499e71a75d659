"""`gradysim means`: means over the runs in a directory."""

import shlex
import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.exit_code import OK, say_mistake


def print_means(
    directory: Annotated[Path, Parameter(name="DIR", help="The directory of `run --result-dir`.")],
    /,
    *quantities: Annotated[
        str,
        Parameter(
            name="QUANTITY",
            help="Quantities to print, by name, such as `uavs[*] heard` or `*delay*`: `*` is any letters, `?`"
            " any single one. Default: all.",
        ),
    ],
    as_csv: Annotated[
        bool, Parameter(name="--csv", negative="", help="Print CSV, with all digits, for other programs.")
    ] = False,
) -> int:
    """Print means over runs, of tracked variables, outcomes and delays, with 95 % confidence intervals."""
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
    from gradysim.results.quantity import name_filter
    from gradysim.scenario.errors import ConfigError, nearest

    quoted = shlex.quote(str(directory))
    try:
        if not directory.is_dir():
            reason = "it is not a directory" if directory.exists() else "there is no such directory"
            raise ConfigError(f"{directory}: {reason}; expected that of `gradysim run FILE --result-dir DIR`")
        results = read_results(directory)
        if not results:
            reason = (
                "no results" if not has_files_for_omnetpp_alone(directory) else "only .sca and .vec files"
            )
            raise ConfigError(
                f"{directory}: it has {reason} of complete runs; expected the JSON files of"
                f" `gradysim run FILE --result-dir {quoted}`"
            )
        found = means(results)
        names = dict.fromkeys(mean.quantity for mean in found)
        for quantity in quantities:
            if not any(map(name_filter(quantity), names)):
                raise ConfigError(
                    f"{directory}: no quantity is called `{quantity}`",
                    expected=f"one that `gradysim means {quoted}` prints",
                    suggestion=nearest(quantity, names),
                )
    except (ConfigError, OSError) as mistake:
        return say_mistake(mistake)
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
            f" `gradysim run FILE --result-dir {quoted} --resume`",
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
    fits = name_filter(quantities or None)
    found = [mean for mean in found if fits(mean.quantity)]
    if as_csv:
        write_csv(found, sys.stdout)
    else:
        console().print(means_table(found))
    return OK
