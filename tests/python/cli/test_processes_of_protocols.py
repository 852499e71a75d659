"""Protocols that fork, start programs or leave a running thread: one run, one result, no process left."""

import json
import os
import signal
import subprocess
import sys

import pytest

from python.cli.command import both_modes, environment, objects, run_command, run_gradysim
from python.processes import is_running, wait_until
from python.thorough import some

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="it looks into /proc")

FORKS = """
import os
import threading
import time

from protocol import Talker


def write_pid():
    with open("pids", "a") as file:
        file.write(f"{os.getpid()}\\n")


class GoesOn(Talker):
    def handle_timer(self, timer):
        if self.provider.get_id() == 0 and 5 <= self.provider.current_time() < 6:
            if os.fork() == 0:
                write_pid()
        super().handle_timer(timer)


class GoesOnForEver(Talker):
    def handle_timer(self, timer):
        if self.provider.get_id() == 0 and 5 <= self.provider.current_time() < 6:
            if os.fork() == 0:
                write_pid()
                while True:
                    time.sleep(0.01)
        super().handle_timer(timer)


class FailsInTheChild(Talker):
    def handle_timer(self, timer):
        if self.provider.get_id() == 0 and 5 <= self.provider.current_time() < 6:
            if os.fork() == 0:
                write_pid()
                raise RuntimeError("in the child")
        super().handle_timer(timer)


class LeavesAThread(Talker):
    def initialize(self):
        super().initialize()
        threading.Thread(target=self.go_on).start()

    def go_on(self):
        while True:
            time.sleep(0.001)
"""


@both_modes
@pytest.mark.parametrize("jobs", some(["2", "1"]))
@pytest.mark.parametrize("protocol", ["GoesOn", "GoesOnForEver", "FailsInTheChild", "LeavesAThread"])
def test_a_run_has_one_result_whatever_its_protocol_begins(gradysim, folder, mode, jobs, protocol):
    (folder / "forks.py").write_text(FORKS)
    capture = ["--pcap", "all"] if mode == "integrated" else []
    files = ("--result-dir", "out", "--scalars", "--vectors", "all", "--replay", "all", *capture)
    name = ("--set", f'*.uavs[*].protocol.class="forks.py:{protocol}"')
    arguments = ("run", "test.ini", "--mode", mode, "--json", "--set", "sim-time-limit=100s")
    done = run_gradysim(folder, *arguments, *name, *files, "-r", "0..1", "--jobs", jobs)
    assert done.returncode == 0, done.stderr
    assert [(run["run"], run["interrupted"]) for run in objects(done.stdout)] == [(0, False), (1, False)]
    pids = (folder / "pids").read_text().split() if (folder / "pids").exists() else []
    assert len(pids) == (0 if protocol == "LeavesAThread" else 2)
    wait_until(lambda: not any(is_running(int(pid)) for pid in pids))
    plain = gradysim(*arguments, *capture, "--replay", "all", "--result-dir", "plain", "-r", "0..1")
    assert plain.returncode == 0
    for file in (folder / "plain").glob("*.pcap"):
        assert (folder / "out" / file.name).read_bytes() == file.read_bytes()
    for run in (0, 1):
        name = f"General-#{run}.{mode}.json"
        ours, theirs = (json.loads((folder / each / name).read_text()) for each in ("out", "plain"))
        assert [node["tracked_variables"] for node in ours["nodes"]] == [
            node["tracked_variables"] for node in theirs["nodes"]
        ]


LEAVES_ITS_PARENT = "(echo $(exec sh -c 'echo $PPID'); exec sleep 97) &"
STARTS = f"""
import os
import signal
import subprocess

from protocol import Talker

COMMAND = os.getpid()  # which imports this module
PROGRAMS = (
    "echo $$; exec sleep 97",
    "exec setsid sh -c 'echo $$; exec sleep 97'",  # leaves its session
    "{LEAVES_ITS_PARENT}",
)


class Starts(Talker):
    def initialize(self):
        super().initialize()
        if self.provider.get_id() == 0:
            with open("pids", "a") as file:
                for program in PROGRAMS:
                    subprocess.Popen(program, shell=True, stdout=file)
            while len(open("pids").readlines()) < len(PROGRAMS):
                pass
            open("started", "w").close()
            END
"""
STARTING = ("--mode", "prototype", "-r", "0", "--set", '*.uavs[*].protocol.class="starts.py:Starts"')


def are_programs_running(folder):
    """Return whether one of the programs runs that Starts has started."""
    pids = [int(line) for line in (folder / "pids").read_text().split()]
    assert len(pids) == 3
    return any(map(is_running, pids))


@pytest.mark.parametrize("jobs", ["1", "2"])
@pytest.mark.parametrize(
    ("end", "code"),
    [("pass", 0), ("raise RuntimeError('spoilt')", 1), ("os._exit(0)", 1), ("os.kill(os.getpid(), 9)", 1)],
)
def test_programs_end_with_the_run(gradysim, folder, end, code, jobs):
    (folder / "starts.py").write_text(STARTS.replace("END", end))
    assert gradysim("run", "test.ini", "--jobs", jobs, *STARTING).returncode == code
    assert not are_programs_running(folder)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
def test_programs_end_with_the_command(folder, number):
    (folder / "starts.py").write_text(STARTS.replace("END", "pass"))
    command = [sys.executable, "-m", "gradysim", "run", "test.ini", "-c", "Endless", *STARTING]
    with subprocess.Popen(command, cwd=folder, env=environment(), stderr=subprocess.DEVNULL) as process:
        wait_until(lambda: (folder / "started").exists())
        assert are_programs_running(folder)
        process.send_signal(number)
    assert process.returncode == (-9 if number == signal.SIGKILL else 128 + number)
    wait_until(lambda: not are_programs_running(folder), 1.0)


def test_programs_end_when_the_time_is_over(folder):
    (folder / "starts.py").write_text(STARTS.replace("END", "os.kill(COMMAND, signal.SIGALRM)"))
    done = run_gradysim(folder, "run", "test.ini", "-c", "Endless", *STARTING, "--stop-after", "1h")
    assert done.returncode == 5
    assert not are_programs_running(folder)


VIEW = """
import subprocess, sys, webbrowser
from gradysim.cli.app import main
from gradysim.replay.live import LiveView

def open_browser(_):
    with open("browser", "w") as file:
        program = subprocess.Popen(["sleep", "97"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        print(program.pid, file=file)

webbrowser.open = open_browser
LiveView.wait_for_viewer = LiveView.wait_for_the_last = lambda *_: None
sys.exit(main())
"""
"""The command, with a browser that shows nothing."""


def test_programs_end_with_a_view_and_the_browser_stays(folder):
    program = STARTS.replace(LEAVES_ITS_PARENT, "echo $$; exec sleep 97").replace("END", "pass")
    (folder / "starts.py").write_text(program)
    done = run_command(folder, sys.executable, "-c", VIEW, "view", "test.ini", *STARTING)
    assert done.returncode == 0
    assert not are_programs_running(folder)
    browser = int((folder / "browser").read_text())
    assert is_running(browser)
    os.kill(browser, signal.SIGKILL)
