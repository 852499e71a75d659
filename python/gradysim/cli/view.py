"""`gradysim view`: shows replays, or a run while it goes on, in a browser."""

import logging
import sys
import tempfile
import time
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from gradysim.cli.errors import FAILED, OK, print_failure, say_mistake
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.options import Mode, ViewOptions
from gradysim.cli.runs import check

if TYPE_CHECKING:
    from gradysim.cli.execution import Run
    from gradysim.replay.live import LiveView
    from gradysim.scenario.scenario import Scenario

_RELOAD_S = 3.0
"""A viewer that comes back within this time has only reloaded the page; seconds of wall time."""

DEFAULTS = ViewOptions()

FilesArgument = Annotated[
    Path,
    Parameter(
        name="FILE",
        help="An .ini file, to run and show at once; or the .html of a replay, or several to compare.",
    ),
]


def view(*files: FilesArgument, options: ViewOptions = DEFAULTS) -> int:
    """Show a run in the browser: while it goes on (FILE.ini), or its replay (FILE.html)."""
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.scenario.errors import ConfigError

    try:
        if all(file.suffix == ".html" for file in files):
            return show_replays(files, options)
        if len(files) > 1:
            raise ConfigError(f"{files[1]}: expected one .ini file, or replays (.html) only")
        if files[0].suffix != ".ini" and files[0].is_file():
            raise ConfigError(f"{files[0]}: not a replay", expected="an .ini file, or a replay (.html)")
        return show_live(files[0], options)
    except (ConfigError, CompiledPartMissingError, OSError, ValueError) as mistake:
        return say_mistake(mistake)


def show_replays(files: tuple[Path, ...], options: ViewOptions) -> int:
    """Open a replay, or several beside each other. Raises ConfigError, OSError and ValueError for others."""
    from gradysim.replay.file import read_parts
    from gradysim.scenario.errors import ConfigError, nearest_file
    from gradysim.viewer.page import page_beside

    for file in files:
        try:
            read_parts(file)
        except FileNotFoundError as error:
            raise ConfigError(
                f"{file}: {error.strerror}",
                expected="a replay",
                suggestion=nearest_file(file, (".html",), str(file)),
            ) from error
    if len(files) == 1:
        page = files[0].resolve()
    else:
        page = Path(tempfile.mkdtemp(prefix="gradysim-")) / "beside.html"
        page.write_text(page_beside(files), encoding="utf-8")
    _open(page.as_uri(), options)
    return OK


def show_live(file: Path, options: ViewOptions) -> int:
    """Run a configuration while viewers watch. Returns when the run has ended and they have left."""
    from gradysim.replay.live import LiveView

    (scenario,) = check(file, options.config, str(options.run), options.settings, options.seed)
    live = LiveView(options.port, options.host)
    with StopOnInterrupt() as interrupt:
        try:
            with interrupt.at_once():
                run = _built(scenario, options.mode, live)
                _open(live.address, options)
                live.wait_for_viewer()
                code = _executed(run)
                print("The run has ended; close the page or press Ctrl-C to end the view.", file=sys.stderr)
                _wait_for_the_last(live)
        except KeyboardInterrupt:
            return interrupt.exit_code
        finally:
            live.stop()
    return code


def _executed(run: "Run") -> int:
    try:
        run.execute()
    except Exception as failure:
        print_failure(failure, sys.stderr)
        return FAILED
    return OK


def _built(scenario: "Scenario", mode: Mode, live: "LiveView") -> "Run":
    if mode == "prototype":
        from gradysim.prototype.run import PrototypeRun

        return PrototypeRun(scenario, replay=live, log_level=logging.INFO)
    from gradysim.integrated.run import IntegratedRun

    return IntegratedRun(scenario, replay=live, log_level=logging.INFO)


def _open(address: str, options: ViewOptions) -> None:
    print(address, flush=True)
    if options.browser:
        webbrowser.open(address)


def _wait_for_the_last(live: "LiveView") -> None:
    """Return when all viewers have left and none has come back."""
    seen_at = time.monotonic()
    while time.monotonic() - seen_at < _RELOAD_S:
        if live.viewers:
            seen_at = time.monotonic()
        time.sleep(0.2)
