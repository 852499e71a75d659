"""The command `gradysim`.

Exit codes: 0 success; 1 a protocol failed, or ended its process, or `verify` found damage; 2 an error in the
arguments or the .ini file, or an error of the system, such as a full disk; 3 another process computes a run;
4 a run needs more than --memory; 5 runs are missing; 130 Ctrl-C; 143 SIGTERM; 129 SIGHUP.
Each command has its own file in `gradysim.cli`.
"""

import os
import sys
from collections.abc import Callable, Sequence
from io import TextIOWrapper
from typing import TYPE_CHECKING

from cyclopts import App, CycloptsError, CycloptsPanel, Group, UnknownOptionError, UnusedCliTokensError

from gradysim.cli.bisect import find_breaking_level
from gradysim.cli.calibrate import calibrate_power
from gradysim.cli.check import check_file
from gradysim.cli.compare import compare
from gradysim.cli.desync import desynchronize_timers
from gradysim.cli.docs import show_docs
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
    if isinstance(error, UnknownOptionError) and error.command_chain:
        return CycloptsPanel(_unknown_option(error))
    if not isinstance(error, UnusedCliTokensError) or not error.unused_tokens:
        return CycloptsPanel(error)
    first = error.unused_tokens[0]
    command = " ".join(["gradysim", *(error.command_chain or ()), "--help"])
    expected = "--set before each KEY=VALUE" if "=" in first else f"an option before it, see {command}"
    return CycloptsPanel(f"{first} is one argument too many; expected {expected}")


def _unknown_option(error: UnknownOptionError) -> str:
    from gradysim.scenario.errors import nearest

    option = error.token.keyword or error.token.value
    known = [name for argument in error.argument_collection for name in argument.names if argument.parse]
    text = f"Unknown option: {option}."
    if suggestion := nearest(option.strip("-"), [name[2:] for name in known if name.startswith("--")]):
        return f"{text} Did you mean --{suggestion}?"
    if "--set" in known and option.startswith("--"):
        key = f"*.nodes[*].protocol.{option[2:]}"
        return f"{text} A parameter of the file is set by its key: --set '{key}=VALUE'"
    return text


app = App(
    name="gradysim",
    help="Simulator of flying networks: one Python protocol, from a prototype to a realistic 802.11 network.",
    version=installed_version,
    suppress_keyboard_interrupt=False,
    error_formatter=mistake_in_arguments,
)
app.register_install_completion_command(help="Install completion for this shell, and end.")

COMMANDS: dict[str, dict[str, tuple[Callable[..., int], str]]] = {
    "Write": {
        "new": (make_project, "gradysim new swarm"),
        "check": (check_file, "gradysim check swarm.ini -c Study"),
        "docs": (show_docs, "gradysim docs fly-a-mission"),
        "keys": (list_keys, "gradysim keys communicationRange"),
        "calibrate": (calibrate_power, "gradysim calibrate swarm.ini --range 50m"),
        "import": (import_file, "gradysim import omnetpp.ini -o imported"),
    },
    "Run": {
        "run": (run, "gradysim run swarm.ini -c Study --jobs 2 --result-dir results"),
        "runs": (list_runs, "gradysim runs swarm.ini -c Study"),
        "status": (print_status, "gradysim status swarm.ini -c Study --result-dir results"),
    },
    "Look": {
        "view": (view, "gradysim view swarm.ini -c Study --run 3"),
    },
    "Evaluate": {
        "means": (print_means, "gradysim means results --metric 'station heard'"),
        "compare": (compare, "gradysim compare results --by mode"),
        "plot": (draw_figure, "gradysim plot results --x jitter --metric 'station heard' -o heard.pdf"),
        "pack": (pack_results, "gradysim pack results --remove"),
        "verify": (verify_files, "gradysim verify results"),
    },
    "Find weaknesses": {
        "ladder": (climb_ladder, "gradysim ladder swarm.ini --metric 'station heard' -o ladder.png"),
        "bisect": (find_breaking_level, "gradysim bisect swarm.ini --assert 'station heard >= 100'"),
        "desync": (desynchronize_timers, "gradysim desync swarm.ini"),
    },
}
"""{group: {command: its function and an example}}, in the order of the help."""

for _group, _commands in COMMANDS.items():
    _shown = Group.create_ordered(_group)
    for _name, (_function, _example) in _commands.items():
        app.command(_function, name=_name, group=_shown, help_epilogue=f"Example: {_example}")
_options = Group.create_ordered("Options")
for _flag in ("--help", "--version", "--install-completion"):
    app[_flag].group = _options


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
        from cyclopts.completion.detect import ShellDetectionError

        if isinstance(end.__context__, ShellDetectionError):
            return MISTAKE  # cyclopts has printed the message
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
