"""`gradysim pack`: the result files of a study in one file."""

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.errors import LOCKED, OK, report_error
from gradysim.cli.options import Flag, ResultDir
from gradysim.cli.progress import waiting
from gradysim.cli.study import check_directory
from gradysim.execution import packing
from gradysim.execution.run_lock import RunLockedError
from gradysim.results.pack import packs_of
from gradysim.scenario.errors import ConfigError


def pack_results(
    directory: Annotated[ResultDir, Parameter(name="DIR")],
    /,
    *,
    output: Annotated[
        Path | None,
        Parameter(alias="-o", help="The pack. Default: DIR/packs/runs.sca, where commands find it."),
    ] = None,
    remove: Annotated[
        Flag, Parameter(help="Then remove the JSON files that are in the pack; with --unpack, the packs.")
    ] = False,
    unpack: Annotated[
        Flag, Parameter(help="Write the JSON files of the packs, unchanged, into DIR again.")
    ] = False,
) -> int:
    """Carry out `gradysim pack`, and return the exit code."""
    file = output or packing.default_pack(directory)
    try:
        check_directory(directory)
        with waiting(f"{'unpacking' if unpack else 'packing'} {directory}", shown=True):
            if unpack:
                packs = packs_of(directory) if output is None else [output]
                count = packing.unpack(directory, packs, remove=remove)
            else:
                count = packing.pack(directory, file, remove=remove)
    except RunLockedError as locked:
        print(f"{directory}: a run is computed there: {locked}; expected its end before", file=sys.stderr)
        return LOCKED
    except (ConfigError, ImportError, OSError) as error:
        return report_error(error)
    runs = "run" if count == 1 else "runs"
    if unpack:
        print(f"unpacked {count:,} {runs} into {directory}{', and removed the packs' if remove else ''}")
    else:
        removed = ", and removed packed JSON files" if remove else ""
        print(f"packed {count:,} new {runs} into {file}{removed}")
    return OK
