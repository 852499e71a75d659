"""Batches of runs in a process of their own."""

import os
import pickle
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import pytest

from gradysim.cli.errors import FAILED, INTERRUPTED, OK
from gradysim.cli.interrupt import KILLING
from gradysim.cli.options import RunOptions
from gradysim.cli.run_task import Command
from gradysim.cli.workers import compute, press
from python.cli.command import environment
from python.processes import wait_until


@pytest.fixture
def command(folder, monkeypatch):
    """`command(options)`: the command whose study is in the directory."""
    monkeypatch.chdir(folder)

    def of(**options):
        run_options = RunOptions(mode="prototype", **options)
        return Command(folder / "test.ini", run_options, 0, (1, 2), os.getcwd(), None, folder.name)

    return of


def test_each_run_has_its_own_output(command):
    rows = compute(command(config="Chatty"), (0, 2))
    assert [row.number for row in rows] == [0, 2]
    for row in rows:
        assert (row.code, row.output_error, row.death) == (OK, None, "")
        output, error_output = row.printed
        assert output.decode().splitlines()[-1].startswith(f"Chatty run {row.number} ")
        assert b"printed by a module" not in output
        assert error_output == b""
        assert row.wall_s > 0


def test_it_stops_after_a_failure(command):
    (row,) = compute(command(config="Failing"), (0, 1))
    assert (row.code, row.death) == (FAILED, "")


def test_it_goes_on_after_a_run_that_is_killed(command, folder):
    (folder / "killed.py").write_text(
        "import os\nfrom protocol import Talker\n"
        "class Killed(Talker):\n    def handle_timer(self, timer):\n        os.kill(os.getpid(), 9)\n"
    )
    rows = compute(command(settings=('*.uavs[*].protocol.class="killed.py:Killed"',)), (0, 1))
    assert [(row.code, row.death) for row in rows] == [(FAILED, "the process was killed by SIGKILL")] * 2


def test_a_batch_that_cannot_be_read_is_an_error(command):
    with pytest.raises(RuntimeError, match="Nowhere"):
        compute(command(config="Nowhere"), (0,))


def test_a_process_that_a_module_starts_does_not_hold_it_up(command, folder):
    (folder / "starts.py").write_text(
        "import os\nfrom protocol import Talker\n"
        "if (started := os.fork()) == 0:\n    os.execlp('sleep', 'sleep', '600')\n"
        "open('started', 'w').write(str(started))\n"
        "class Starts(Talker):\n    pass\n"
    )
    settings = ('*.uavs[*].protocol.class="starts.py:Starts"',)
    with ThreadPoolExecutor(1) as executor:
        batch = executor.submit(compute, command(settings=settings), (0, 1))
        try:
            assert [row.code for row in batch.result(60)] == [OK, OK]
        finally:
            os.kill(int((folder / "started").read_text()), signal.SIGKILL)


def test_its_data_are_plain(command):
    data = pickle.dumps((command(), tuple(range(1000))))
    assert len(data) < 10_000


NOTES = """
import os
from protocol import Talker

BATCH = os.getpid()

class Notes(Talker):
    def handle_timer(self, timer):
        super().handle_timer(timer)
        if not os.path.exists("began"):
            with open("begins", "w") as file:
                file.write(str(BATCH))
            os.rename("begins", "began")
"""


@pytest.fixture
def endless(command, folder):
    """A command whose runs do not end, and a function that waits for one and returns the batch's process."""
    (folder / "notes.py").write_text(NOTES)
    began = folder / "began"

    def wait_for_process():
        wait_until(began.exists)
        return int(began.read_text())

    options = {"result_dir": folder / "out", "settings": ('*.uavs[*].protocol.class="notes.py:Notes"',)}
    return command(config="Endless", **options), wait_for_process


@pytest.fixture
def begun(endless):
    """The future of the rows of an endless batch, of which a run is under way."""
    command, wait_for_process = endless
    with ThreadPoolExecutor(1) as executor:
        try:
            computing = executor.submit(compute, command, (0, 1))
            wait_for_process()
            yield computing
        finally:
            press(command.id, KILLING)


def test_ctrl_c_ends_the_run_under_way_and_keeps_its_results(begun, folder):
    press(folder.name, 1)
    press(folder.name, 1)  # it is passed on again and again
    assert [(row.number, row.code) for row in begun.result(60)] == [(0, INTERRUPTED)]
    assert [file.name for file in (folder / "out").glob("*.json")] == ["Endless-#0.prototype.json"]


def test_after_ctrl_c_no_run_begins(command):
    press(command().id, 0)
    assert compute(command(), (0, 1)) == []


def test_the_third_press_kills_it(begun, folder):
    press(folder.name, KILLING)
    with pytest.raises(RuntimeError, match="-9"):
        begun.result(60)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells a process of its parent's death")
def test_it_ends_with_its_worker(endless):
    code = (
        "import pickle, sys; from gradysim.cli.workers import compute;"
        " compute(pickle.load(sys.stdin.buffer), (0, 1))"
    )
    command, wait_for_process = endless
    worker = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, env=environment())
    worker.stdin.write(pickle.dumps(command))
    worker.stdin.close()
    process = f"/proc/{wait_for_process()}"
    worker.send_signal(signal.SIGKILL)
    worker.wait()
    wait_until(lambda: not os.path.exists(process), 5)
