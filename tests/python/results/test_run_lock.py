import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from gradysim.results.run_lock import LOCK_FILE, RunLockedError, remove_left_over_files, run_locked

HOLDS = """
import sys, time
from pathlib import Path
from gradysim.results.run_lock import run_locked
with run_locked(Path(sys.argv[1]), sys.argv[2]):
    print("held", flush=True)
    time.sleep(1000)
"""


@pytest.fixture
def holder(tmp_path: Path) -> Iterator[subprocess.Popen[str]]:
    """Start another process that holds the lock of `A`."""
    with subprocess.Popen(
        [sys.executable, "-c", HOLDS, str(tmp_path), "A"],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "held\n"
        yield process
        process.kill()


def test_one_process_at_a_time_has_a_run(tmp_path, holder):
    with pytest.raises(RunLockedError) as raised, run_locked(tmp_path, "A"):
        pass
    assert raised.value.pid == (holder.pid if sys.platform == "linux" else None)
    with run_locked(tmp_path, "B"):
        pass


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_the_end_of_a_process_is_the_end_of_its_lock(tmp_path, holder, number):
    holder.send_signal(number)
    holder.wait()
    with run_locked(tmp_path, "A"):
        pass


def test_a_missing_directory_is_made(tmp_path):
    with run_locked(tmp_path / "a" / "b", "A"):
        assert (tmp_path / "a" / "b").is_dir()


def left_over(directory: Path) -> list[str]:
    for name in ("A-#0.integrated.json.12", "A-#1-uavs[0].pcap.4194304", "A-#0.integrated.json", "notes.12"):
        (directory / name).touch()
    remove_left_over_files(directory)
    return sorted(entry.name for entry in directory.iterdir())


def test_what_killed_runs_left_is_removed(tmp_path):
    (tmp_path / LOCK_FILE).touch()
    assert left_over(tmp_path) == ["A-#0.integrated.json", "notes.12"]


def test_nothing_is_removed_while_a_run_goes_on(tmp_path, holder):
    assert len(left_over(tmp_path)) == 5
    holder.kill()
    holder.wait()
    assert len(left_over(tmp_path)) == 2


def test_a_missing_directory_has_nothing_left_over(tmp_path):
    remove_left_over_files(tmp_path / "missing")
    assert not (tmp_path / "missing").exists()


RACES = """
import sys
from pathlib import Path
from gradysim.results.run_lock import RunLockedError, remove_left_over_files, run_locked
directory, name = Path(sys.argv[1]), sys.argv[2]
for _ in range(300):
    with run_locked(directory, name):
        remaining = directory / f"{name}.json.1"
        remaining.touch()
        remaining.unlink()  # raises if another process took it for left over
    remove_left_over_files(directory)
"""


def test_removing_the_lock_file_never_gives_a_lock_to_two_nor_refuses_one(tmp_path):
    commands = [[sys.executable, "-c", RACES, str(tmp_path), name] for name in "ABC"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    processes = [subprocess.Popen(command, env=environment) for command in commands]
    assert [process.wait(60) for process in processes] == [0, 0, 0]
