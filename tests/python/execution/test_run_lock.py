import contextlib
import errno
import fcntl
import json
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from gradysim.execution import run_lock
from gradysim.execution.run_lock import (
    LEASE_S,
    LOCK_FILE,
    RunLockedError,
    all_runs_locked,
    remove_left_over_files,
    run_locked,
)
from python.processes import wait_until

HOLDS = """
import sys, time
from pathlib import Path
from gradysim.execution.run_lock import run_locked
with run_locked(Path(sys.argv[1]), sys.argv[2]):
    print("held", flush=True)
    time.sleep(1000)
"""


@contextlib.contextmanager
def holding(directory: Path, code: str) -> Iterator[subprocess.Popen[str]]:
    """Start another process that holds the lock of `A`."""
    with subprocess.Popen(
        [sys.executable, "-c", code, str(directory), "A"],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "held\n"
        yield process
        process.kill()


@pytest.fixture
def holder(tmp_path: Path) -> Iterator[subprocess.Popen[str]]:
    with holding(tmp_path, HOLDS) as process:
        yield process


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


NO_LOCKS = """
import errno, fcntl
def lockf(*arguments):
    raise OSError(errno.ENOLCK, "no locks")
fcntl.lockf = lockf
"""


@pytest.fixture
def no_locks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make this process find a file system without locks."""

    def lockf(*_: object) -> None:
        raise OSError(errno.ENOLCK, "no locks")

    monkeypatch.setattr(fcntl, "lockf", lockf)


@pytest.fixture
def leaser(tmp_path: Path, no_locks: None) -> Iterator[subprocess.Popen[str]]:
    """Start another process that computes `A` in a directory without locks."""
    with holding(tmp_path, NO_LOCKS + HOLDS) as process:
        yield process


def lease_of(directory: Path) -> Path:
    (lease,) = directory.glob(".gradysim.lease.*")
    return lease


def let_it_expire(lease: Path) -> None:
    before_s = lease.stat().st_mtime - LEASE_S - 1
    os.utime(lease, (before_s, before_s))


def test_without_locks_one_process_at_a_time_has_a_run(tmp_path, leaser):
    with pytest.raises(RunLockedError) as raised, run_locked(tmp_path, "A"):
        pass
    assert (raised.value.pid, raised.value.host) == (leaser.pid, socket.gethostname())
    with run_locked(tmp_path, "B"):
        pass
    assert lease_of(tmp_path).exists()  # that of B is gone


def test_without_locks_a_killed_process_has_its_run_until_its_lease_expires(tmp_path, leaser):
    leaser.kill()
    leaser.wait()
    with pytest.raises(RunLockedError), run_locked(tmp_path, "A"):
        pass
    let_it_expire(lease_of(tmp_path))
    with run_locked(tmp_path, "A"):
        assert json.loads(lease_of(tmp_path).read_text())["pid"] == os.getpid()
    assert not list(tmp_path.glob(".gradysim.lease.*"))


def test_a_lease_is_touched_while_the_run_goes_on(tmp_path, no_locks, monkeypatch):
    monkeypatch.setattr(run_lock, "HEARTBEAT_S", 0.001)
    with run_locked(tmp_path, "A"):
        lease = lease_of(tmp_path)
        let_it_expire(lease)
        now_s = (tmp_path / LOCK_FILE).stat().st_mtime
        wait_until(lambda: lease.stat().st_mtime > now_s - LEASE_S / 2)


def test_a_process_whose_lease_has_expired_leaves_that_of_the_next_one(tmp_path, no_locks):
    with contextlib.ExitStack() as first:
        first.enter_context(run_locked(tmp_path, "A"))
        let_it_expire(lease_of(tmp_path))
        with run_locked(tmp_path, "A"):
            first.close()
            assert lease_of(tmp_path).exists()


def test_without_locks_nothing_is_removed(tmp_path, no_locks):
    assert len(left_over(tmp_path)) == 4 + len([LOCK_FILE])
    assert not remove_left_over_files(tmp_path)


def test_without_locks_all_runs_are_locked_if_none_is_computed(tmp_path, leaser):
    with pytest.raises(RunLockedError) as raised, all_runs_locked(tmp_path):
        pass
    assert raised.value.pid == leaser.pid
    let_it_expire(lease_of(tmp_path))
    with all_runs_locked(tmp_path), pytest.raises(RunLockedError), run_locked(tmp_path, "B"):
        pass


def test_another_error_of_a_lock_names_the_file(tmp_path, monkeypatch):
    def lockf(*_: object) -> None:
        raise OSError(errno.EIO, "damaged")

    monkeypatch.setattr(fcntl, "lockf", lockf)
    with pytest.raises(OSError, match="damaged") as raised, run_locked(tmp_path, "A"):
        pass
    assert raised.value.filename == str(tmp_path / LOCK_FILE)


RACES = """
import sys
from pathlib import Path
from gradysim.execution.run_lock import RunLockedError, remove_left_over_files, run_locked
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
