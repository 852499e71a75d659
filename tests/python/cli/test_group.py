"""A group of runs in a process of its own."""

import os
import pickle
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import pytest

from gradysim.cli.errors import INTERRUPTED
from gradysim.cli.group import KILLING, Group, compute, press
from gradysim.cli.options import RunOptions
from gradysim.cli.run_task import LineStart
from gradysim.cli.runner import WorkerError
from python.cli.command import environment
from python.processes import wait_until


@pytest.fixture
def group(folder, monkeypatch):
    """`group(*numbers, options)`: a group of the study in the directory."""
    monkeypatch.chdir(folder)

    def of(*numbers, **options):
        run_options = RunOptions(mode="prototype", **options)
        file, line, name = folder / "test.ini", LineStart(1, 2), folder.name
        return Group(file, run_options, numbers, 0, line, os.getcwd(), None, name)

    return of


def test_each_run_has_its_own_output(group):
    result = compute(group(0, 2, config="Chatty"))
    assert list(result.ended) == [0, 2]
    for number, ended in result.ended.items():
        assert ended.outcome == (0, None)
        output, error_output = ended.printed
        assert output.decode().splitlines()[-1].startswith(f"Chatty run {number}  #{number}  said 10")
        assert b"printed by a module" not in output
        assert error_output == b""
    assert result.duration_s > 0


def test_it_stops_after_a_failure(group):
    result = compute(group(0, 1, config="Failing"))
    assert [ended.outcome for ended in result.ended.values()] == [(1, None)]


def test_it_goes_on_after_a_run_that_is_killed(group, folder):
    (folder / "killed.py").write_text(
        "import os\nfrom protocol import Talker\n"
        "class Killed(Talker):\n    def handle_timer(self, timer):\n        os.kill(os.getpid(), 9)\n"
    )
    result = compute(group(0, 1, settings=('*.uavs[*].protocol.class="killed.py:Killed"',)))
    outcomes = [ended.outcome for ended in result.ended.values()]
    assert all(isinstance(outcome, WorkerError) and outcome.exit_code == -9 for outcome in outcomes)
    assert [str(outcome) for outcome in outcomes] == ["the process was killed by SIGKILL"] * 2


def test_a_group_that_cannot_be_read_is_an_error(group):
    with pytest.raises(RuntimeError, match="Nowhere"):
        compute(group(0, config="Nowhere"))


def test_its_data_are_plain(group):
    data = pickle.dumps(group(*range(1000)))
    assert len(data) < 10_000


NOTES = """
import os
from protocol import Talker

GROUP = os.getpid()

class Notes(Talker):
    def handle_timer(self, timer):
        super().handle_timer(timer)
        if not os.path.exists("began"):
            with open("begins", "w") as file:
                file.write(str(GROUP))
            os.rename("begins", "began")
"""


@pytest.fixture
def endless(group, folder):
    """A group of runs that do not end, and a function that waits for one and returns the group's process."""
    (folder / "notes.py").write_text(NOTES)
    began = folder / "began"

    def wait_for_process():
        wait_until(began.exists)
        return int(began.read_text())

    options = {"result_dir": folder / "out", "settings": ('*.uavs[*].protocol.class="notes.py:Notes"',)}
    return group(0, 1, config="Endless", **options), wait_for_process


@pytest.fixture
def begun(endless):
    """The future of the result of an endless group, of which a run is under way."""
    group, wait_for_process = endless
    with ThreadPoolExecutor(1) as executor:
        try:
            computing = executor.submit(compute, group)
            wait_for_process()
            yield computing
        finally:
            press(group.command, KILLING)


def test_ctrl_c_ends_the_run_under_way_and_keeps_its_results(begun, folder):
    press(folder.name, 1)
    press(folder.name, 1)  # it is passed on again and again
    ended = begun.result(60).ended
    assert {number: run.outcome for number, run in ended.items()} == {0: (INTERRUPTED, None)}
    assert [file.name for file in (folder / "out").glob("*.json")] == ["Endless-#0.prototype.json"]


def test_after_ctrl_c_no_run_begins(group):
    press(group().command, 0)
    assert compute(group(0, 1)).ended == {}


def test_the_third_press_kills_it(begun, folder):
    press(folder.name, KILLING)
    with pytest.raises(RuntimeError, match="-9"):
        begun.result(60)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells a process of its parent's death")
def test_it_ends_with_its_worker(endless):
    code = (
        "import pickle, sys; from gradysim.cli.group import compute; compute(pickle.load(sys.stdin.buffer))"
    )
    group, wait_for_process = endless
    worker = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, env=environment())
    worker.stdin.write(pickle.dumps(group))
    worker.stdin.close()
    process = f"/proc/{wait_for_process()}"
    worker.send_signal(signal.SIGKILL)
    worker.wait()
    wait_until(lambda: not os.path.exists(process), 5)
