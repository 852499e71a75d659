import sys
import time

import pytest

from gradysim.sitl.error import SitlError
from gradysim.sitl.process import AutopilotProcess, stop_all
from python.simulator.handler.ardupilot_mobility.flying import programs_left_in

STUBBORN = (
    "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); print(1, flush=True); time.sleep(60)"
)


@pytest.fixture
def start(tmp_path):
    started = []

    def run(program, arguments=()):
        command = [sys.executable, "-c", program, *arguments]
        process = AutopilotProcess("node 1", command, tmp_path, tmp_path / f"{len(started)}.log")
        started.append(process)
        return process

    yield run
    stop_all(started)


def ended(process):
    assert process.wait_until(time.monotonic() + 20)
    return process.obituary()


@pytest.mark.parametrize(
    ("program", "words"),
    [
        ("import sys; sys.exit(5)", "the autopilot ended with status 5, and printed nothing"),
        ("print('a'); print('b')", "the autopilot ended with status 0; it printed last: a | b"),
        ("import os; os.kill(os.getpid(), 11)", "the autopilot died of SIGSEGV, and printed nothing"),
        ("import sys; sys.exit(128 + 9)", "the autopilot died of SIGKILL, and printed nothing"),
    ],
)
def test_the_end_is_told(start, program, words):
    assert ended(start(program)) == words


def test_only_the_last_lines_are_told(start):
    assert ended(start("print(*range(100), sep='\\n')")).endswith("it printed last: 95 | 96 | 97 | 98 | 99")


def test_arguments_are_no_shells(start):
    assert "$HOME `id` ;" in ended(start("import sys; print(sys.argv[1])", ["$HOME `id` ;"]))


def test_it_runs_in_its_folder(start, tmp_path):
    assert str(tmp_path) in ended(start("import os; print(os.getcwd())"))


def test_what_cannot_be_started_is_told(tmp_path):
    with pytest.raises(SitlError, match=r"^node 1: the autopilot cannot be started: .*nothing"):
        AutopilotProcess("node 1", [str(tmp_path / "nothing")], tmp_path, tmp_path / "log")


def test_those_that_do_not_follow_sigterm_are_killed(start, tmp_path):
    stubborn, mild = start(STUBBORN), start("import time; time.sleep(60)")
    while not (tmp_path / "0.log").read_text():
        time.sleep(0.01)
    stop_all([stubborn, mild], grace_s=0.2)
    assert "SIGKILL" in stubborn.obituary()
    assert "SIGTERM" in mild.obituary()


def test_what_a_wrapper_started_ends_with_it(start, tmp_path):
    child = tmp_path / "child.py"
    child.write_text(STUBBORN)
    wrapper = start(f"import subprocess, sys; subprocess.run([sys.executable, {str(child)!r}])")
    while not (tmp_path / "0.log").read_text():
        time.sleep(0.01)
    stop_all([wrapper], grace_s=0.2)
    assert "SIGTERM" in wrapper.obituary()
    assert programs_left_in(tmp_path) == []


def test_stopping_what_has_ended_does_nothing(start):
    process = start("pass")
    ended(process)
    stop_all([process])
    assert not process.is_running
