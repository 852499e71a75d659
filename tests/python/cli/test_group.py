"""A group of runs in a process of its own."""

import os
import pickle
import signal
import subprocess
import sys
import time

import pytest

from gradysim.cli.group import Group, compute
from gradysim.cli.options import RunOptions
from gradysim.cli.run_task import LineStart
from gradysim.cli.runner import WorkerError
from python.cli.command import environment
from python.processes import wait_until


@pytest.fixture
def group(folder, monkeypatch):
    """`group(*numbers, options)`: a group of the study in the directory."""
    monkeypatch.chdir(folder)

    def of(*numbers, stop_at_s=None, **options):
        run_options = RunOptions(mode="prototype", **options)
        line = LineStart(1, 2)
        return Group(folder / "test.ini", run_options, numbers, 0, line, os.getcwd(), None, stop_at_s)

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


def test_it_stops_when_the_time_is_over(group):
    assert compute(group(0, 1, stop_at_s=time.time() - 1)).ended == {}


def test_a_group_that_cannot_be_read_is_an_error(group):
    with pytest.raises(RuntimeError, match="Nowhere"):
        compute(group(0, config="Nowhere"))


def test_its_data_are_plain(group):
    data = pickle.dumps(group(*range(1000)))
    assert len(data) < 10_000


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells a process of its parent's death")
def test_it_ends_with_its_worker(group, folder):
    code = (
        "import pickle, sys; from gradysim.cli.group import compute; compute(pickle.load(sys.stdin.buffer))"
    )
    began = folder / "began"
    (folder / "notes.py").write_text(
        "import os\nfrom protocol import Talker\nGROUP = os.getpid()\n"
        "class Notes(Talker):\n    def initialize(self):\n"
        f"        super().initialize()\n        open({str(began)!r}, 'w').write(str(GROUP))\n"
    )
    endless = group(0, config="Endless", settings=('*.uavs[*].protocol.class="notes.py:Notes"',))
    worker = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, env=environment())
    worker.stdin.write(pickle.dumps(endless))
    worker.stdin.close()
    wait_until(lambda: began.exists() and began.read_text() != "")
    worker.send_signal(signal.SIGKILL)
    worker.wait()
    process = f"/proc/{began.read_text()}"
    wait_until(lambda: not os.path.exists(process), 5)
