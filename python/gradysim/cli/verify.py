"""`gradysim verify`: whether the files of a study are complete, and as their runs left them."""

from gradysim.cli.errors import FAILED, OK, report_error
from gradysim.cli.options import ResultsArgument
from gradysim.cli.progress import waiting
from gradysim.cli.study import check_directory
from gradysim.results.verify import verify
from gradysim.scenario.errors import ConfigError


def verify_files(directory: ResultsArgument, /) -> int:
    """Carry out `gradysim verify`, and return the exit code."""
    try:
        if not directory.is_file():
            check_directory(directory)
        with waiting(f"verifying {directory}", shown=True):
            files = list(verify(directory))
        if not files:
            raise ConfigError(f"{directory}: it has no results; expected those of `gradysim run`")
    except (ConfigError, OSError) as error:
        return report_error(error)
    bad = [file for file in files if file.problem]
    for file in bad:
        print(f"{file.path}: {file.problem}")
    count = "1 file" if len(files) == 1 else f"{len(files):,} files"
    if bad:
        print(f"{directory}: {len(bad):,} of {count} {'is' if len(bad) == 1 else 'are'} damaged or missing")
        return FAILED
    unnamed = sum(not file.has_hash for file in files)
    more = f"; {unnamed:,} of them without a checksum, as no result names them" if unnamed else ""
    print(f"{directory}: {count} {'is' if len(files) == 1 else 'are'} complete and undamaged{more}")
    return OK
