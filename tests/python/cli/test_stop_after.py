"""`gradysim run --stop-after`: a command that ends in time for a scheduler."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from gradysim.cli import run_task
from gradysim.cli.errors import INCOMPLETE
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.options import RunOptions
from python.cli.command import both_modes, run_gradysim

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="it has no timer")

ENDLESS = ("run", "test.ini", "-c", "Endless", "--result-dir", "out")


def stopped(folder: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Run `Endless` until its time is over: as short as this machine needs to start all runs at once."""
    for duration_s in (0.5, 1, 2, 4, 8):
        done = run_gradysim(folder, *ENDLESS, *options, "--stop-after", f"{duration_s}s")
        if len(list((folder / "out").iterdir())) == (2 if "2" in options else 1):
            break
    return done


@both_modes
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_running_runs_end_as_after_ctrl_c(folder: Path, mode: str, jobs: str) -> None:
    done = stopped(folder, "--mode", mode, "--jobs", jobs)
    assert done.returncode == 5
    assert "\n--stop-after: " in done.stderr
    count = int(jobs)
    assert done.stderr.endswith(" (1..2)\n" if count == 1 else " (2)\n")
    results = [json.loads(path.read_text()) for path in (folder / "out").iterdir()]
    assert [result["interrupted"] for result in results] == [True] * count
    assert all(result["sim_time_s"] > 0 for result in results)


def test_a_callback_that_never_returns_is_left(folder: Path) -> None:
    (folder / "spins.py").write_text(
        "from protocol import Talker\nclass Spins(Talker):\n"
        "    def handle_timer(self, timer):\n        while True: pass\n"
    )
    spins = ("--set", '*.uavs[*].protocol.class="spins.py:Spins"')
    done = stopped(folder, "--mode", "prototype", *spins)
    assert done.returncode == 5
    assert "spins.py" in done.stderr


def test_a_study_that_is_done_in_time_is_complete(gradysim) -> None:
    done = gradysim("run", "test.ini", "--mode", "prototype", "--quiet", "--stop-after", "1h")
    assert (done.returncode, done.stderr) == (0, "")


def test_no_run_starts_when_the_time_is_over(gradysim) -> None:
    done = gradysim("run", "test.ini", "--mode", "prototype", "--stop-after", "1us")
    assert (done.returncode, done.stdout) == (5, "")
    assert "(0..2)" in done.stderr


def test_a_machine_may_be_slow_to_start_the_first_run(gradysim, monkeypatch) -> None:
    def press_once_more(_: RunOptions) -> None:
        signal.raise_signal(signal.SIGALRM)

    monkeypatch.setattr(run_task, "import_what_runs_use", press_once_more)
    done = gradysim("run", "test.ini", "--mode", "prototype", "--stop-after", "1us")
    assert (done.returncode, done.stdout) == (5, "")


@pytest.mark.parametrize("text", ["10", "0s", "1kB", "-1s", "9999999h"])
def test_other_values_are_errors(gradysim, text: str) -> None:
    done = gradysim("run", "test.ini", "--mode", "prototype", "--stop-after=" + text)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"--stop-after {text}: ")


def test_ctrl_c_comes_first() -> None:
    with StopOnInterrupt(60) as interrupt:
        signal.raise_signal(signal.SIGINT)
    assert interrupt.exit_code == 130
    with StopOnInterrupt(0) as interrupt:
        time.sleep(0.1)
    assert interrupt.exit_code == INCOMPLETE
