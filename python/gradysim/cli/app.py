"""The command `gradysim`.

    gradysim new NAME [--example]
    gradysim run FILE.ini [-c CONFIG] [-r RUNS] [--mode integrated|prototype] ...
    gradysim check FILE.ini [-c CONFIG]
    gradysim view FILE.ini|FILE.html...
    gradysim runs FILE.ini [-c CONFIG]
    gradysim status DIR FILE.ini [-c CONFIG] [--missing]
    gradysim means DIR [QUANTITY...] [--csv]
    gradysim compare DIR DIR [--metric QUANTITY] ...
    gradysim plot DIR --x VARIABLE --y QUANTITY -o FILE ...
    gradysim import FILE.ini [-o DIR]
    gradysim pack DIR [-o FILE] [--remove] [--unpack]
    gradysim verify DIR
    gradysim ladder FILE.ini [-c CONFIG] --metric QUANTITY ...
    gradysim bisect FILE.ini [-c CONFIG] --assert 'QUANTITY >= NUMBER' ...
    gradysim desync FILE.ini [-c CONFIG] ...
    gradysim keys [PATTERN] [--markdown]
    gradysim calibrate FILE.ini [-c CONFIG] --range 50m ...

Exit codes: 0 success; 1 a protocol failed, or ended its process, or `verify` found damage; 2 an error in the
arguments or the .ini file, or an error of the system, such as a full disk; 3 another process computes a run;
4 a run needs more than --memory; 5 runs are missing; 130 Ctrl-C; 143 SIGTERM; 129 SIGHUP.
Each command has its own file in `gradysim.cli`.
"""

import os
import sys
from collections.abc import Sequence
from io import TextIOWrapper
from typing import TYPE_CHECKING

from cyclopts import App, CycloptsError, CycloptsPanel, UnusedCliTokensError

from gradysim.cli.bisect import find_breaking_level
from gradysim.cli.calibrate import calibrate_power
from gradysim.cli.check import check_file
from gradysim.cli.compare import compare
from gradysim.cli.desync import desynchronize_timers
from gradysim.cli.errors import INTERRUPTED, MISTAKE, OK, abandon_output, is_about_output, say_mistake
from gradysim.cli.import_file import import_file
from gradysim.cli.keys import list_keys
from gradysim.cli.ladder import climb_ladder
from gradysim.cli.means import print_means
from gradysim.cli.new import make_project
from gradysim.cli.pack import pack_results
from gradysim.cli.plot import draw_figure
from gradysim.cli.run import run
from gradysim.cli.runs import list_runs
from gradysim.cli.status import print_status
from gradysim.cli.verify import verify_files
from gradysim.cli.view import view

if TYPE_CHECKING:
    from rich.console import RenderableType


def installed_version() -> str:
    """Return the version of the installed package."""
    import gradysim

    try:
        return gradysim.__version__
    except ModuleNotFoundError:
        return "unknown (gradysim is not installed)"


def mistake_in_arguments(error: CycloptsError) -> "RenderableType":
    """Return the message of an error. cyclopts reports only `Unused Tokens` for a superfluous argument."""
    if not isinstance(error, UnusedCliTokensError) or not error.unused_tokens:
        return CycloptsPanel(error)
    first = error.unused_tokens[0]
    command = " ".join(["gradysim", *(error.command_chain or ()), "--help"])
    expected = "--set before each KEY=VALUE" if "=" in first else f"an option before it, see {command}"
    return CycloptsPanel(f"{first} is one argument too many; expected {expected}")


app = App(
    name="gradysim",
    help="Simulator of flying networks: one Python protocol, from a prototype to a realistic 802.11 network.",
    version=installed_version,
    suppress_keyboard_interrupt=False,
    error_formatter=mistake_in_arguments,
)
app.command(run)
app.command(check_file, name="check")
app.command(view)
app.command(make_project, name="new")
app.command(list_runs, name="runs")
app.command(print_status, name="status")
app.command(print_means, name="means")
app.command(compare)
app.command(draw_figure, name="plot")
app.command(pack_results, name="pack")
app.command(verify_files, name="verify")
app.command(climb_ladder, name="ladder")
app.command(desynchronize_timers, name="desync")
app.command(find_breaking_level, name="bisect")
app.command(list_keys, name="keys")
app.command(import_file, name="import")
app.command(calibrate_power, name="calibrate")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command line, by default the command line of this process, and return the exit code."""
    if sys.stdout is None:  # the caller closed it
        sys.stdout = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115 (it stays for the process)
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115 (likewise)
    if isinstance(sys.stdout, TextIOWrapper) and sys.stdout.errors == "strict":
        sys.stdout.reconfigure(errors="backslashreplace")  # so that every character can be printed
    try:
        try:
            code = app(arguments, exit_on_error=False, print_error=True, result_action="return_value")
        finally:
            sys.stdout.flush()  # here, where a failing output is handled
    except CycloptsError:  # cyclopts has printed the message
        return MISTAKE
    except KeyboardInterrupt:
        return INTERRUPTED
    except SystemExit as end:
        if isinstance(end.__context__, BrokenPipeError):
            return OK  # rich converts it
        raise
    except OSError as error:
        if not is_about_output(error):
            return say_mistake(error)
        abandon_output()
        if isinstance(error, BrokenPipeError):  # the reader, such as `head`, has closed the pipe
            return OK
        print(f"standard output: {error.strerror}", file=sys.stderr)
        return MISTAKE
    return code if isinstance(code, int) else OK
