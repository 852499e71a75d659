"""Protocols that fork in a callback, or leave a running thread: one run, one result, one exit code."""

import json
import sys
from pathlib import Path

import pytest

from python.cli.command import both_modes, objects, run_gradysim
from python.processes import wait_until
from python.thorough import some

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


def is_running(pid: int) -> bool:
    """Return whether a process runs, and is not a zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


@pytest.mark.skipif(sys.platform != "linux", reason="it looks into /proc")
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
