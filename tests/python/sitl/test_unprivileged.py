import getpass
import os
import subprocess
import sys

import pytest

from gradysim.sitl.error import SitlError
from gradysim.sitl.unprivileged import command_as, user_for


def test_a_command_runs_without_the_rights_of_root():
    """Root runs it as the user wanted, anybody else as himself; its parent belongs to the same user."""
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
    """What it holds open, here the standard error of all, is closed then."""
    command = command_as(user_for(wanted), ["sh", "-c", "trap '' HUP TERM PIPE; echo; exec sleep 60"])
    subprocess.run([sys.executable, "-c", PARENT, *command], stderr=subprocess.PIPE, check=False, timeout=20)


def test_an_unknown_user_is_refused(monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    with pytest.raises(SitlError, match="there is no user 'nobody at all'"):
        user_for("nobody at all")


def test_a_missing_tool_is_named(monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(SitlError, match="root needs the command setpriv"):
        user_for("nobody")
