"""Output for a failing protocol."""

import contextlib
import os
import pty
import subprocess
import sys

import pytest

from python.cli.command import both_modes, deaths, environment, objects, run_gradysim


@both_modes
def test_a_failing_protocol(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", mode, "-r", "0")
    assert done.returncode == 1
    lines = done.stderr.splitlines()
    assert lines[0].startswith("Traceback")
    assert "protocol.py" in lines[1]
    assert lines[-2].endswith("spoilt")
    assert "(Failing 1) at 1" in lines[-1]


CARELESS = """
import asyncio

class Careless(Talker):
    def handle_packet(self, message):
        {}
"""
OF_CARELESS = ("--set", '*.uavs[*].protocol.class = "protocol.py:Careless"', "--result-dir", "out")


def assert_told_with_results(done, folder, mode, error):
    """Check that a callback of Careless failed, and that earlier results are printed and kept."""
    assert done.returncode == 1
    assert done.stderr.splitlines()[-2] == error
    assert "(Careless 1) at 1" in done.stderr.splitlines()[-1]
    assert "   said\n" in done.stdout
    assert (folder / f"out/General-#0.{mode}.json").is_file()


@both_modes
def test_a_protocol_that_raises_what_is_no_exception_as_others(gradysim, folder, mode):
    with (folder / "protocol.py").open("a") as protocol:
        protocol.write(CARELESS.format('raise asyncio.CancelledError("given up")'))
    done = gradysim("run", "test.ini", "--mode", mode, "-r", "0", *OF_CARELESS)
    assert_told_with_results(done, folder, mode, "asyncio.exceptions.CancelledError: given up")


@both_modes
@pytest.mark.parametrize("options", [(), ("--vectors", "all")])
def test_variables_that_are_none_fail_where_they_are_assigned(gradysim, folder, mode, options):
    with (folder / "protocol.py").open("a") as protocol:
        protocol.write(CARELESS.format("self.provider.tracked_variables = None"))
    done = gradysim("run", "test.ini", "--mode", mode, "-r", "0", *OF_CARELESS, *options)
    assert_told_with_results(done, folder, mode, "TypeError: tracked_variables = None: expected a dict")


@both_modes
def test_why_it_failed_comes_last_on_a_screen(folder, mode):
    done = subprocess.run(
        [sys.executable, "-m", "gradysim", "run", "test.ini", "-c", "Failing", "--mode", mode, "-r", "0"],
        cwd=folder,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=60,
    )
    assert done.stdout.index("Failing run 0") < done.stdout.index("Traceback")
    assert "(Failing 1) at 1" in done.stdout.splitlines()[-1]


@both_modes
def test_what_it_computed_until_then_is_shown(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", mode)
    assert "interrupted" in done.stdout
    assert "  said " in done.stdout


@both_modes
def test_the_runs_after_it_are_not_begun_and_that_is_said(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", mode, "--json")
    assert done.stderr.endswith(" (1..2)\n")
    assert [(run["run"], run["interrupted"]) for run in objects(done.stdout)] == [(0, True)]


@both_modes
def test_a_protocol_that_cannot_be_made(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Unmakeable", "--mode", mode)
    assert done.returncode == 1
    assert "RuntimeError" in done.stderr
    assert "node 0 (Unmakeable 0)" in done.stderr
    assert done.stdout == ""


ENDS = """
import ctypes
import multiprocessing
import os

from protocol import Talker


class EndsItself(Talker):
    status = 0

    def handle_timer(self, timer):
        os._exit(self.status)


class Forks(Talker):
    def handle_timer(self, timer):
        child = multiprocessing.get_context("fork").Process(target=print)
        child.start()
        child.join()
        self.provider.tracked_variables["code"] = child.exitcode


class Crashes(Talker):
    def handle_timer(self, timer):
        ctypes.string_at(0)
"""


@both_modes
@pytest.mark.parametrize("status", [0, 3])
def test_a_protocol_that_ends_the_process(gradysim, folder, mode, status):
    (folder / "ends.py").write_text(ENDS)
    settings = ('class="ends.py:EndsItself"', f"status={status}")
    arguments = [part for line in settings for part in ("--set", f"*.uavs[*].protocol.{line}")]
    done = gradysim("run", "test.ini", "--mode", mode, "-r", "0,2", *arguments)
    assert (done.returncode, done.stdout) == (1, "printed by a protocol\n" * 4)
    assert deaths(done.stderr) == {0: str(status), 2: str(status)}


def test_a_protocol_that_ends_the_process_of_a_terminal_leaves_it_with_its_cursor(folder):
    (folder / "ends.py").write_text(ENDS)
    name = '*.uavs[*].protocol.class="ends.py:EndsItself"'
    ours, theirs = pty.openpty()
    done = subprocess.run(
        [sys.executable, "-m", "gradysim", "run", "test.ini", "--mode", "prototype", "--set", name],
        cwd=folder,
        env={**environment(), "TERM": "xterm"},
        stdout=subprocess.PIPE,
        stderr=theirs,
        timeout=60,
    )
    os.close(theirs)
    shown = b""
    with os.fdopen(ours, "rb", buffering=0) as terminal, contextlib.suppress(OSError):  # end of the output
        while chunk := terminal.read(4096):
            shown += chunk
    assert done.returncode == 1
    assert shown.rindex(b"\x1b[?25h") > shown.rindex(b"\x1b[?25l")


def test_a_process_that_a_protocol_began_ends_as_it_wants_to(gradysim, folder):
    (folder / "ends.py").write_text(ENDS)
    name = '*.uavs[*].protocol.class="ends.py:Forks"'
    done = gradysim("run", "test.ini", "--mode", "prototype", "-r", "0", "--json", "--set", name)
    assert done.returncode == 0
    assert "os._exit" not in done.stderr
    (run,) = objects(done.stdout)
    assert [node["tracked_variables"]["code"] for node in run["nodes"]] == [0, 0]


@both_modes
def test_a_crash_of_the_interpreter_is_told_with_its_line(folder, mode):
    (folder / "ends.py").write_text(ENDS)
    name = '*.uavs[*].protocol.class="ends.py:Crashes"'
    done = run_gradysim(folder, "run", "test.ini", "--mode", mode, "-r", "0", "--set", name)
    assert done.returncode == 1
    assert f'{folder / "ends.py"}", line 26 ' in done.stderr
    assert deaths(done.stderr) == {0: "SIGSEGV"}


def test_a_crash_of_several_runs_at_once_is_told_with_its_line(folder):
    (folder / "ends.py").write_text(ENDS)
    name = '*.uavs[*].protocol.class="ends.py:Crashes"'
    arguments = ("--mode", "prototype", "-r", "0,1", "-j", "2", "--set", name)
    done = run_gradysim(folder, "run", "test.ini", *arguments)
    assert done.returncode == 1
    assert done.stderr.count(f'{folder / "ends.py"}", line 26 ') == 2
    assert deaths(done.stderr) == {0: "SIGSEGV", 1: "SIGSEGV"}
