"""The process of an autopilot, its user and its directory."""

import getpass
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from gradysim.sitl import SitlError
from gradysim.sitl.process import AutopilotProcess, FleetDirectory, command_as, stop_all, user_for
from python.sitl.ardupilot_mobility.flying import programs_left_in

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
    return process.exit_report()


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
    assert ended(start("print(*range(100), sep='\\n')")).endswith(": 95 | 96 | 97 | 98 | 99")


def test_arguments_are_no_shells(start):
    assert "$HOME `id` ;" in ended(start("import sys; print(sys.argv[1])", ["$HOME `id` ;"]))


def test_it_runs_in_its_folder(start, tmp_path):
    assert str(tmp_path) in ended(start("import os; print(os.getcwd())"))


def test_what_cannot_be_started_is_told(tmp_path):
    with pytest.raises(SitlError, match=r"^node 1: .*nothing"):
        AutopilotProcess("node 1", [str(tmp_path / "nothing")], tmp_path, tmp_path / "log")


def test_those_that_do_not_follow_sigterm_are_killed(start, tmp_path):
    stubborn, mild = start(STUBBORN), start("import time; time.sleep(60)")
    while not (tmp_path / "0.log").read_text():
        time.sleep(0.01)
    stop_all([stubborn, mild], grace_s=0.2)
    assert "SIGKILL" in stubborn.exit_report()
    assert "SIGTERM" in mild.exit_report()


def test_what_a_wrapper_started_ends_with_it(start, tmp_path):
    child = tmp_path / "child.py"
    child.write_text(STUBBORN)
    wrapper = start(f"import subprocess, sys; subprocess.run([sys.executable, {str(child)!r}])")
    while not (tmp_path / "0.log").read_text():
        time.sleep(0.01)
    stop_all([wrapper], grace_s=0.2)
    assert "SIGTERM" in wrapper.exit_report()
    assert programs_left_in(tmp_path) == []


def test_stopping_what_has_ended_does_nothing(start):
    process = start("pass")
    ended(process)
    stop_all([process])
    assert not process.is_running


def test_a_command_runs_without_the_rights_of_root():
    """Root runs it as the configured user, other users as themselves. Its parent belongs to the same user."""
    user = user_for("nobody")
    expected = "nobody" if os.geteuid() == 0 else getpass.getuser()
    command = command_as(user, ["sh", "-c", "id -un; kill -0 $PPID && echo may signal its parent"])
    output = subprocess.run(command, capture_output=True, text=True, check=True, timeout=20).stdout
    assert output.split("\n")[:2] == [expected, "may signal its parent"]


def test_its_status_is_passed_on():
    command = command_as(user_for("nobody"), ["sh", "-c", "exit 7"])
    assert subprocess.run(command, check=False, timeout=20).returncode == 7


def test_root_may_want_root():
    assert user_for(None) is None
    assert subprocess.run(command_as(None, ["true"]), check=False, timeout=20).returncode == 0


def test_without_the_tool_whoever_is_not_root_runs_it_as_it_is(monkeypatch):
    monkeypatch.setenv("PATH", "")
    assert command_as(None, ["a", "b"]) == ["a", "b"]


PARENT = """
import os, signal, subprocess, sys
child = subprocess.Popen(sys.argv[1:], stdout=subprocess.PIPE)
child.stdout.readline()
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.parametrize("wanted", ["nobody", None])
def test_it_ends_with_its_parent(wanted):
    """Its open files, here the standard error of all, are closed then."""
    command = command_as(user_for(wanted), ["sh", "-c", "trap '' HUP TERM PIPE; echo; exec sleep 60"])
    subprocess.run([sys.executable, "-c", PARENT, *command], stderr=subprocess.PIPE, check=False, timeout=20)


def test_an_unknown_user_is_refused(monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    with pytest.raises(SitlError, match="'nobody at all'"):
        user_for("nobody at all")


def test_a_missing_tool_is_named(monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(SitlError, match="setpriv"):
        user_for("nobody")


OWNER = """
import sys
from gradysim.sitl.process import FleetDirectory
folder = FleetDirectory()
(folder.path / "0").mkdir()
(folder.path / "0" / "log").write_text("flying")
print(folder.path, flush=True)
sys.stdin.read()
"""


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))


@pytest.fixture
def owner(tmp_path):
    """Return another process with a directory, and that directory."""
    process = subprocess.Popen(
        [sys.executable, "-c", OWNER],
        env={**os.environ, "TMPDIR": str(tmp_path), "PYTHONPATH": os.pathsep.join(sys.path)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    with process:
        yield process, Path(process.stdout.readline().strip())
        process.kill()


def folders(tmp_path):
    return sorted(tmp_path.glob("gradysim-sitl-*"))


def test_it_is_there_until_it_is_removed(tmp_path):
    folder = FleetDirectory()
    assert folders(tmp_path) == [folder.path]
    folder.remove()
    folder.remove()
    assert folders(tmp_path) == []


def test_that_of_an_owner_who_was_killed_is_removed_by_the_next(owner, tmp_path):
    process, theirs = owner
    process.kill()
    process.wait()
    assert (theirs / "0" / "log").exists()
    ours = FleetDirectory()
    assert folders(tmp_path) == [ours.path]
    ours.remove()


def test_that_of_an_owner_who_lives_stays(owner, tmp_path):
    _, theirs = owner
    ours, other = FleetDirectory(), FleetDirectory()
    assert folders(tmp_path) == sorted([theirs, ours.path, other.path])
    ours.remove()
    other.remove()


def test_what_has_no_lock_stays(tmp_path):
    (tmp_path / "gradysim-sitl-mine").mkdir()
    (tmp_path / "gradysim-sitl-file").write_text("")
    FleetDirectory().remove()
    assert [folder.name for folder in folders(tmp_path)] == ["gradysim-sitl-file", "gradysim-sitl-mine"]


def test_that_of_another_user_stays(owner, tmp_path, monkeypatch):
    process, theirs = owner
    process.kill()
    process.wait()
    monkeypatch.setattr("os.geteuid", lambda: theirs.stat().st_uid + 1)
    FleetDirectory().remove()
    assert folders(tmp_path) == [theirs]


def test_a_link_to_a_folder_elsewhere_is_not_followed(owner, tmp_path):
    process, theirs = owner
    process.kill()
    process.wait()
    elsewhere = theirs.rename(tmp_path / "elsewhere")
    (tmp_path / "gradysim-sitl-link").symlink_to(elsewhere)
    FleetDirectory().remove()
    assert (elsewhere / "0" / "log").exists()
