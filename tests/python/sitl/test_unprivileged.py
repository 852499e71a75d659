import getpass
import os
import subprocess

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
    assert command_as(None, ["a", "b"]) == ["a", "b"]


def test_an_unknown_user_is_refused(monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    with pytest.raises(SitlError, match="there is no user 'nobody at all'"):
        user_for("nobody at all")


def test_a_missing_tool_is_named(monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(SitlError, match="root needs the command setpriv"):
        user_for("nobody")
