"""Effect of signals on commands and their worker processes.

`test_view_ends.py` does the same for `gradysim view`, and `test_executors.py` for a study on Dask. Commands
that only read and write files are interrupted at each of their system calls, by `test_faults.py`.
"""

import contextlib
import json
import os
import pty
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from gradysim.cli.interrupt import STOPPING
from gradysim.execution.run_lock import all_runs_locked
from gradysim.replay.file import read_parts
from python.cli.command import both_modes, compiled, environment, objects
from python.processes import session, wait_until
from python.thorough import some

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="it looks into /proc")

ENDS_WITHIN_S = 3.0
"""Usually 0.4 s after SIGTERM and SIGHUP; longer on a busy machine."""

MOST_LINES = 3
"""That the command stops, which callback does not return, and which runs are missing."""

PROTOCOLS = """
import os
import time
from protocol import Talker

class Ready(Talker):
    is_ready = False

    def handle_timer(self, timer):
        if self.provider.get_id() == 0 and not self.is_ready:
            self.is_ready = True
            with open("ready", "ab") as file:
                file.write(b"x")
        super().handle_timer(timer)


class Spins(Ready):
    def handle_timer(self, timer):
        super().handle_timer(timer)
        while True:
            pass


class Sleeps(Ready):
    def handle_timer(self, timer):
        super().handle_timer(timer)
        time.sleep(1000)


class Building(Talker):
    def __init__(self):
        with open("ready", "ab") as file:
            file.write(b"x")
        time.sleep(1000)
"""

Begin = Callable[..., subprocess.Popen[str]]


@pytest.fixture
def begin(folder: Path) -> Iterator[Begin]:
    """`begin(protocol, runs, *arguments)`: the command after the start of these runs, in its own session."""
    (folder / "signals.py").write_text(PROTOCOLS)
    begun = []

    def begin(
        protocol: str, runs: int, *arguments: str, command: str = "run", **options: object
    ) -> subprocess.Popen[str]:
        name = f'*.uavs[*].protocol.class="signals.py:{protocol}"'
        line = (command, "test.ini", "-c", "Endless", "--set", name, *arguments)
        process = subprocess.Popen(
            [sys.executable, "-m", "gradysim", *line],
            **{
                "cwd": folder,
                "env": environment(),
                "stdout": subprocess.PIPE,
                "stderr": subprocess.PIPE,
                "text": True,
                "start_new_session": True,
                **options,
            },
        )
        begun.append(process)
        ready = folder / "ready"
        wait_until(lambda: not runs or (ready.exists() and ready.stat().st_size >= runs))
        assert process.poll() is None
        return process

    yield begin
    for process in begun:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


COMMANDS = {
    "run": ("--mode", "prototype", "--quiet"),
    "ladder": ("--metric", "uavs said", "-n", "2"),
    "bisect": ("--assert", "uavs said >= 1"),
    "desync": ("--metric", "uavs said", "-n", "2"),
}
STATES = {"building": "Building", "running": "Ready", "in a callback": "Spins"}
TABLE = [
    pytest.param(command, state, number, marks=[] if is_in_short else pytest.mark.verify)
    for at, command in enumerate(COMMANDS)
    for state in STATES
    for number in STOPPING
    if (command, state) != ("run", "in a callback")  # whose results have a test below
    for is_in_short in [
        state == ("running" if command != "run" else "building") and number == STOPPING[at % len(STOPPING)]
    ]
]
"""`make test` has each command with one state and signal."""


@compiled
@pytest.mark.parametrize(("command", "state", "number"), TABLE)
def test_each_command_ends_in_each_state(begin, command, state, number):
    process = begin(STATES[state], 1, *COMMANDS[command], command=command)
    assert_ends(process, number)


@pytest.mark.parametrize("number", some(STOPPING))
def test_a_command_that_waits_for_a_lock_ends(begin, folder, number):
    (folder / "out").mkdir()
    with all_runs_locked(folder / "out"):
        process = begin("Ready", 0, "--mode", "prototype", "--quiet", "--result-dir", "out")
        wait_until(lambda: len(session(process.pid)) == 1 + 2)  # the run waits, and has a guardian
        assert_ends(process, number)


def assert_ends(process: subprocess.Popen[str], number: int) -> None:
    """Send a signal to a command, and check that it ends soon, says so in few lines and leaves no process."""
    began = time.monotonic()
    process.send_signal(number)
    _, errors = process.communicate(timeout=20)
    assert process.returncode == 128 + number
    assert time.monotonic() - began < ENDS_WITHIN_S
    assert session(process.pid) == []
    assert "stop" in errors
    assert len(errors.strip().splitlines()) <= MOST_LINES


@pytest.mark.parametrize("protocol", ["Spins", "Sleeps"])
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_no_process_outlives_the_command(begin, protocol, number):
    process = begin(protocol, 2, "--mode", "prototype", "--jobs", "2", "--quiet")
    assert len(session(process.pid)) == 1 + 2 * 2  # each run has a guardian
    process.send_signal(number)
    wait_until(lambda: not session(process.pid), ENDS_WITHIN_S)
    process.communicate()
    assert process.returncode == (-9 if number == signal.SIGKILL else 128 + number)


@both_modes
@pytest.mark.parametrize("jobs", ["1", "2"])
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_what_was_computed_is_kept(begin, folder, mode, jobs, number):
    capture = ["--pcap", "uavs[0]"] if mode == "integrated" else []
    files = ("--result-dir", "out", "--scalars", "--vectors", "uavs", "--replay", "all", *capture)
    process = begin("Ready", int(jobs), "--mode", mode, "--jobs", jobs, "--json", *files)
    process.send_signal(number)
    out, err = process.communicate(timeout=20)
    assert process.returncode == 128 + number
    assert [(run["run"], run["interrupted"]) for run in objects(out)] == [(i, True) for i in range(int(jobs))]
    assert err.endswith(" (1..2)\n" if jobs == "1" else " (2)\n")
    result = json.loads((folder / f"out/Endless-#0.{mode}.json").read_text())
    suffixes = {".sca", ".vec", ".html", *([".pcap"] if capture else [])}
    assert {Path(name).suffix for name in result["output_hashes"]} == suffixes
    _, _, end = read_parts(folder / f"out/Endless-#0.{mode}.html")
    assert end == {"time_s": result["sim_time_s"], "complete": False}


def test_a_callback_that_does_not_return_costs_no_results(begin, folder):
    process = begin("Spins", 2, "--mode", "prototype", "--jobs", "2", "--json", "--result-dir", "out")
    process.terminate()
    out, err = process.communicate(timeout=20)
    assert (process.returncode, len(objects(out))) == (143, 2)
    assert "(Spins 0)" in err
    assert len(list((folder / "out").iterdir())) == 2


def test_signals_to_the_whole_group_at_once_are_one_press(begin):
    process = begin("Ready", 2, "--mode", "prototype", "--jobs", "2", "--json")
    for number in (signal.SIGTERM, signal.SIGHUP):
        os.killpg(process.pid, number)
    out, err = process.communicate(timeout=20)
    assert process.returncode in (143, 129)  # of the first one that arrives
    assert [run["interrupted"] for run in objects(out)] == [True, True]
    assert "Traceback" not in err


def test_a_hangup_that_is_ignored_stays_ignored(begin):
    process = begin("Ready", 1, "--mode", "prototype", "--json", preexec_fn=ignore_hangup)
    os.killpg(process.pid, signal.SIGHUP)
    ignored = int(status(process.pid)["SigIgn"], 16)
    assert ignored & 1 << signal.SIGHUP - 1
    process.terminate()
    out, _ = process.communicate(timeout=20)
    assert (process.returncode, len(objects(out))) == (143, 1)


def ignore_hangup() -> None:
    signal.signal(signal.SIGHUP, signal.SIG_IGN)


def status(pid: int) -> dict[str, str]:
    """Return the kernel's status of a process."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return {name: value.strip() for name, _, value in (line.partition(":") for line in lines)}


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_terminal_that_is_closed_costs_no_results(begin, folder, jobs):
    ours, theirs = pty.openpty()
    process = begin(
        "Ready",
        int(jobs),
        *("--mode", "prototype", "--jobs", jobs, "--result-dir", "out"),
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        start_new_session=False,
        preexec_fn=control_terminal,
        env={**environment(), "TERM": "xterm"},
    )
    os.close(theirs)
    os.close(ours)
    assert process.wait(20) == 129
    assert not session(process.pid)
    files = sorted((folder / "out").iterdir())
    assert [file.name for file in files] == [f"Endless-#{run}.prototype.json" for run in range(int(jobs))]
    assert all(json.loads(file.read_text())["interrupted"] for file in files)


def control_terminal() -> None:
    """Become the leader of a session whose terminal is standard input."""
    os.setsid()
    import fcntl
    import termios

    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
