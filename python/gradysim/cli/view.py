"""`gradysim view`: shows replays, or a run while it goes on, in a browser."""

import logging
import sys
import webbrowser
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.errors import FAILED, OK, print_failure, report_error
from gradysim.cli.guardian import children, ending_children
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.options import Mode, ViewOptions
from gradysim.cli.runs import check
from gradysim.cli.single_run import Run
from gradysim.integrated.compiled_part import CompiledPartMissingError
from gradysim.integrated.run import IntegratedRun
from gradysim.replay.beside import ReplaysBeside
from gradysim.replay.file import read_parts
from gradysim.replay.live import LiveView
from gradysim.results.durable import naming
from gradysim.scenario.errors import ConfigError, nearest_file
from gradysim.scenario.scenario import Scenario

_GRACE_S = 0.4
"""Wall time for callbacks of protocols to return after Ctrl-C, and then for `finish`, in seconds."""

_HOW_TO_END = "Close the page or press Ctrl-C to end the view."

DEFAULTS = ViewOptions()

FilesArgument = Annotated[
    Path,
    Parameter(
        name="FILE",
        help="An .ini file, to run and show at once; or the .html of a replay, or several to compare.",
    ),
]


def view(*files: FilesArgument, options: ViewOptions = DEFAULTS) -> int:
    """Carry out `gradysim view`, and return the exit code."""
    try:
        if all(file.suffix == ".html" for file in files):
            check_replays(files)
            return show_replay(files[0], options) if len(files) == 1 else show_beside(files, options)
        if len(files) > 1:
            raise ConfigError(f"{files[1]}: expected one .ini file, or replays (.html) only")
        if files[0].suffix != ".ini" and files[0].is_file():
            raise ConfigError(f"{files[0]}: not a replay", expected="an .ini file, or a replay (.html)")
        return show_live(files[0], options)
    except (ConfigError, CompiledPartMissingError, OSError, ValueError) as error:
        return report_error(error)


def check_replays(files: Sequence[Path]) -> None:
    """Warn of replays that end early. Raises ConfigError, OSError and ValueError for other files."""
    for file in files:
        try:
            with naming(file):
                _, _, end = read_parts(file)
        except FileNotFoundError as error:
            raise ConfigError(
                f"{file}: {error.strerror}",
                expected="a replay",
                suggestion=nearest_file(file, (".html",), str(file)),
            ) from error
        if end is None:
            reason = "its run was killed or goes on, or the file was cut"
            print(f"{file}: the replay is not complete: {reason}", file=sys.stderr)


def show_replay(file: Path, options: ViewOptions) -> int:
    """Open the file of a replay."""
    address = file.resolve().as_uri()
    _open(address, address, options)
    return OK


def show_beside(files: Sequence[Path], options: ViewOptions) -> int:
    """Show several replays beside each other. Returns when the viewers have left."""
    interrupt = StopOnInterrupt(grace_s=_GRACE_S)
    try:
        with ReplaysBeside(files, options.port, options.host) as server, interrupt:
            _open(server.address, server.address_for_once, options)
            server.wait_for_viewer(interrupt.should_stop)
            if not interrupt.should_stop():
                print(_HOW_TO_END, file=sys.stderr)
                server.wait_for_the_last(interrupt.should_stop)
    except KeyboardInterrupt:
        return interrupt.exit_code
    return interrupt.exit_code if interrupt.should_stop() else OK


def show_live(file: Path, options: ViewOptions) -> int:
    """Run a configuration while viewers watch. Returns when the run has ended and they have left."""
    interrupt = StopOnInterrupt(grace_s=_GRACE_S)
    try:
        with ending_children() as browsers, LiveView(options.port, options.host) as live, interrupt:
            with interrupt.at_once():
                (scenario,) = check(file, options.config, str(options.run), options.settings, options.seed)
                run = _built(scenario, options.mode, live)
            of_protocols = children()
            _open(live.address, live.address_for_once, options)
            browsers.update({*children()}.difference(of_protocols))
            live.wait_for_viewer(interrupt.should_stop)
            code = _executed(run, live, interrupt)
            if not interrupt.should_stop():
                print("The run has ended.", _HOW_TO_END, file=sys.stderr)
                live.wait_for_the_last(interrupt.should_stop)
    except KeyboardInterrupt:
        return interrupt.exit_code
    return interrupt.exit_code if interrupt.should_stop() else code


def _executed(run: Run, live: LiveView, interrupt: StopOnInterrupt) -> int:
    try:
        with interrupt.executing():
            run.execute(should_stop=live.paced(interrupt.should_stop))
    except Exception as failure:
        print_failure(failure, sys.stderr)
        return FAILED
    return OK


def _built(scenario: Scenario, mode: Mode, live: LiveView) -> Run:
    if mode == "prototype":
        from gradysim.prototype.run import PrototypeRun

        return PrototypeRun(scenario, replay=live, log_level=logging.INFO)

    return IntegratedRun(scenario, replay=live, log_level=logging.INFO)


def _open(address: str, address_for_browser: str, options: ViewOptions) -> None:
    print(address, flush=True)
    if options.browser:
        webbrowser.open(address_for_browser)
