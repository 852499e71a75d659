"""The progress bar of `gradysim run`."""

import os
import pty
import subprocess
import sys

import pytest

from python.cli.command import environment


@pytest.mark.parametrize(("options", "bar"), [((), True), (("--quiet",), False), (("--json",), False)])
def test_the_bar_is_for_terminals(folder, options, bar):
    ours, theirs = pty.openpty()
    with subprocess.Popen(
        [sys.executable, "-m", "gradysim", "run", "test.ini", "-r", "0", "--mode", "prototype", *options],
        cwd=folder,
        env={**environment(), "TERM": "xterm"},
        stdout=subprocess.PIPE,
        stderr=theirs,
        text=True,
    ) as process:
        os.close(theirs)
        shown = b""
        with os.fdopen(ours, "rb", buffering=0) as terminal:
            while chunk := read_terminal(terminal):
                shown += chunk
        process.communicate()
    assert (b"x real time" in shown or b"of 10 s" in shown) is bar


def read_terminal(terminal):
    try:
        return terminal.read(4096)
    except OSError:  # on Linux: the other side is closed
        return b""
