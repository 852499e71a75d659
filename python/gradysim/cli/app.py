"""The command `gradysim`.

Exit codes: 0 success; 1 a protocol failed, or ended its process, or `verify` found damage; 2 an error in the
arguments or the .ini file, or an error of the system, such as a full disk; 3 another process computes a run;
4 a run needs more than --memory; 5 runs are missing; 130 Ctrl-C; 143 SIGTERM; 129 SIGHUP.
Each command has its own file in `gradysim.cli`.
"""

import os
import sys
from collections.abc import Sequence
from io import TextIOWrapper
from typing import TYPE_CHECKING, Any

from cyclopts import App, CycloptsError, CycloptsPanel, Group, UnknownOptionError, UnusedCliTokensError

from gradysim.cli.errors import INTERRUPTED, MISTAKE, OK, abandon_output, is_about_output, report_error

if TYPE_CHECKING:
    from cyclopts.help import HelpPanel
    from rich.console import Console, ConsoleOptions, RenderableType


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


class FlowingHelp:
    """Prints helps as cyclopts does, but joins the lines of the help of an option, which is a docstring."""

    def __getattr__(self, name: str) -> Any:
        from cyclopts.help import DefaultFormatter

        return getattr(DefaultFormatter(), name)

    def __call__(self, console: "Console", options: "ConsoleOptions", panel: "HelpPanel") -> None:
        """Print a part of a help."""
        for entry in panel.entries:
            text = entry.description.primary_renderable
            text.plain = " ".join(text.plain.split())
        self.__getattr__("__call__")(console, options, panel)


app = App(
    name="gradysim",
    help="Simulator of flying networks: one Python protocol, from a prototype to a realistic 802.11 network.",
    version=installed_version,
    suppress_keyboard_interrupt=False,
    help_format="plaintext",  # to render Markdown takes a third of the time of a help
    help_formatter=FlowingHelp(),
    error_formatter=mistake_in_arguments,
)
app.register_install_completion_command(help="Install completion for this shell, and end.")

COMMANDS = {
    "Write": {
        "new": (
            "new:make_project",
            "Make a directory with a protocol, scenarios and a test, or a copy of an example.",
            "gradysim new swarm",
        ),
        "check": (
            "check:check_file",
            "Report the errors and warnings that show before the first run, sorted by line.",
            "gradysim check swarm.ini -c Study",
        ),
        "explain": (
            "explain:explain_parameter",
            "Explain the value of a parameter: the line that sets it, the lines it hides, and what reads it.",
            "gradysim explain swarm.ini 'uavs[3].mobility.speed'",
        ),
        "docs": (
            "docs:show_docs",
            "Show a page of the documentation, or list the pages that have a word in their title or text.",
            "gradysim docs fly-a-mission",
        ),
        "keys": (
            "keys:list_keys",
            "List the keys of .ini files: unit, default, meaning.",
            "gradysim keys communicationRange",
        ),
        "calibrate": (
            "calibrate:calibrate_power",
            "Find the transmission power for a wanted range, or the path loss for measured powers or"
            " deliveries.",
            "gradysim calibrate swarm.ini --range 50m",
        ),
        "import": (
            "import_file:import_file",
            "Translate an .ini file of OMNeT++, and list what was done with each line.",
            "gradysim import omnetpp.ini -o imported",
        ),
    },
    "Run": {
        "run": (
            "run:run",
            "Run the runs of a configuration and report their results.",
            "gradysim run swarm.ini -c Study --jobs 2 --result-dir results",
        ),
        "runs": (
            "runs:list_runs",
            "List the runs of a configuration.",
            "gradysim runs swarm.ini -c Study",
        ),
        "status": (
            "status:print_status",
            "List which runs of a configuration are done. The exit code is 0 only if all of them are.",
            "gradysim status swarm.ini -c Study --result-dir results",
        ),
    },
    "Look": {
        "view": (
            "view:view",
            "Show a run in the browser: while it goes on (FILE.ini), or its replay (FILE.html).",
            "gradysim view swarm.ini -c Study --run 3",
        ),
    },
    "Evaluate": {
        "means": (
            "means:print_means",
            "Print means over runs, of tracked variables, outcomes and delays, with 95 % confidence"
            " intervals.",
            "gradysim means results --metric 'station heard'",
        ),
        "compare": (
            "compare:compare",
            "Compare two studies, or two modes or configurations of one, by pairs of runs with the same"
            " seed.",
            "gradysim compare results --by mode",
        ),
        "plot": (
            "plot:draw_figure",
            "Draw a figure of the runs in a directory, and write its numbers and their origin next to it.",
            "gradysim plot results --x jitter --metric 'station heard' -o heard.pdf",
        ),
        "pack": (
            "pack:pack_results",
            "Put the JSON files of a directory into one SQLite file, which other commands read in their"
            " place.",
            "gradysim pack results --remove",
        ),
        "verify": (
            "verify:verify_files",
            "Verify checksums and hashes of all files of a study, and print a line for each bad file.",
            "gradysim verify results",
        ),
    },
    "Find weaknesses": {
        "ladder": (
            "ladder:climb_ladder",
            "Run a configuration with more and more effects of real radios, and print what each level"
            " changes.\n\nA run that fails does not count in the means. The exit code is 1 then.",
            "gradysim ladder swarm.ini --metric 'station heard' -o ladder.png",
        ),
        "bisect": (
            "bisect:find_breaking_level",
            "Find the lowest level of realism at which a protocol fails, and say why.\n\nExit code 0: the"
            " assertion holds in all runs, and each level was run; 1: it fails in some. Two replays are"
            " written to --result-dir (default: results).",
            "gradysim bisect swarm.ini --assert 'station heard >= 100'",
        ),
        "desync": (
            "desync:desynchronize_timers",
            "Find timers of nodes that send into each other, and the random delay (jitter) that they"
            " need.\n\nExit code 1: all runs without jitter fail.",
            "gradysim desync swarm.ini",
        ),
    },
}
"""{group: {command: its function, its help and an example}}, in the order of the help.

The file of a function in `gradysim.cli` is imported only when the command is called.
"""

for _group, _commands in COMMANDS.items():
    _shown = Group.create_ordered(_group)
    for _name, (_function, _help, _example) in _commands.items():
        app.command(
            f"gradysim.cli.{_function}",
            name=_name,
            group=_shown,
            help=_help,
            help_epilogue=f"Example: {_example}",
        )
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
            return report_error(error)
        abandon_output()
        if isinstance(error, BrokenPipeError):  # the reader, such as `head`, has closed the pipe
            return OK
        print(f"standard output: {error.strerror}", file=sys.stderr)
        return MISTAKE
    return code if isinstance(code, int) else OK
