"""The command, called in this process or as a separate process, and its directory."""

import contextlib
import io
import json
import os
import re
import resource
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from importlib import util
from pathlib import Path

import pytest

from gradysim.cli.app import main
from python.quiet_protocol import QUIET

PROTOCOL = f"""{QUIET}
import signal
import sys
from gradysim.protocol.messages.communication import BroadcastMessageCommand

class Talker(Quiet):
    def initialize(self):
        print("printed by a protocol")
        self.provider.tracked_variables["said"] = 0
        self.provider.schedule_timer("talk", 1 + 0.01 * self.provider.get_id())
    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))
        self.provider.tracked_variables["said"] += 1
        self.provider.schedule_timer("talk", self.provider.current_time() + 1)

class Failing(Talker):
    def handle_packet(self, message):
        raise RuntimeError("spoilt")

class Endless(Talker):
    def initialize(self):
        super().initialize()
        print("ready", file=sys.stderr, flush=True)

class Stuck(Talker):
    def handle_timer(self, timer):
        while True:
            signal.raise_signal(signal.SIGINT)

class StuckInTheMaking(Quiet):
    def __init__(self):
        signal.raise_signal(signal.SIGINT)

class Unmakeable(Quiet):
    def __init__(self):
        raise RuntimeError("no constructor")
"""


INI = """[General]
sim-time-limit = 10.5s
repeat = 3
*.uavs.count = 2
*.uavs[*].protocol.class = "protocol.py:Talker"
*.uavs[*].mobility.lineStepX = 10m
*.uavs[*].mobility.telemetryInterval = 0s

[Config Failing]
*.uavs[*].protocol.class = "protocol.py:Failing"

[Config Endless]
sim-time-limit = 2500h
*.uavs[*].protocol.class = "protocol.py:Endless"
*.uavs[*].mobility.telemetryInterval = 0.1s

[Config Stuck]
*.uavs[*].protocol.class = "protocol.py:Stuck"

[Config StuckInTheMaking]
*.uavs[*].protocol.class = "protocol.py:StuckInTheMaking"

[Config Unmakeable]
*.uavs[*].protocol.class = "protocol.py:Unmakeable"

[Config Chatty]
*.uavs[*].protocol.class = "chatty.py:Talker"

[Config LateMistake]
*.uavs[*].wlan[*].mac.dcf.channelAccess.cwMin = 20000 * ${runnumber}
*.uavs[*].mobility.telemetryInterval = 1ns * (${runnumber} % 2)

[Config WrongKey]
*.uavs[*].mobility.sped = 3mps
"""


LINE_OF_THE_WRONG_KEY = INI.splitlines().index("*.uavs[*].mobility.sped = 3mps") + 1


compiled = pytest.mark.skipif(
    util.find_spec("gradysim._netsim") is None, reason="the compiled part is not installed"
)


both_modes = pytest.mark.parametrize("mode", [pytest.param("integrated", marks=compiled), "prototype"])


Gradysim = Callable[..., subprocess.CompletedProcess[str]]


def environment() -> dict[str, str]:
    """Return the environment of a process with the modules of this one and buffered output."""
    inherited = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    return {**inherited, "PYTHONPATH": os.pathsep.join(sys.path), "COLUMNS": "100"}


def run_command(folder: Path, *command: str) -> subprocess.CompletedProcess[str]:
    """Run any command in a directory, for at most a minute."""
    return subprocess.run(
        command, cwd=folder, env=environment(), capture_output=True, text=True, timeout=60, check=False
    )


def run_gradysim(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the command in a directory, as a separate process. `call_gradysim` takes a tenth of the time."""
    return run_command(folder, sys.executable, "-m", "gradysim", *arguments)


def call_gradysim(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Call the command in a directory, in this process, which it forks for each run."""
    output, error_output = io.StringIO(), io.StringIO()
    streams = contextlib.redirect_stdout(output), contextlib.redirect_stderr(error_output)
    with contextlib.chdir(folder), streams[0], streams[1], pytest.MonkeyPatch.context() as patch:
        patch.setenv("COLUMNS", "100")
        try:
            code = main(arguments)
        except SystemExit as end:
            code = end.code
    return subprocess.CompletedProcess(arguments, code, output.getvalue(), error_output.getvalue())


def run_without(module: str, folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the command in a directory where a module is not installed."""
    code = f"import sys; sys.modules[{module!r}] = None; from gradysim.cli.app import main; sys.exit(main())"
    return run_command(folder, sys.executable, "-c", code, *arguments)


@contextlib.contextmanager
def disk_of(size: int) -> Iterator[None]:
    """Limit the size in bytes of files of this process and of its children."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)


def objects(output: str) -> list[dict]:
    """Return the JSON objects of an output, one per line."""
    return [json.loads(line) for line in output.splitlines()]


def deaths(error_output: str) -> dict[int, str]:
    """Return the last word about each run whose process died: its status, its signal or its limit."""
    lines = re.findall(r"^\w+ run (\d+): .* (\S+)$", error_output, re.MULTILINE)
    return {int(run): word for run, word in lines}


def interrupt_endless_run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the config `Endless` in a directory, and end it with Ctrl-C after its start."""
    command = [sys.executable, "-m", "gradysim", "run", "test.ini", "-c", "Endless", *arguments]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, cwd=folder, env=environment(), text=True, **pipes) as process:
        while "ready" not in (line := process.stderr.readline()):
            assert line, "it ended before it was ready"
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    return subprocess.CompletedProcess(command, process.returncode, out, err)
