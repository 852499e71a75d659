"""What a user sees of a protocol that fails."""

import subprocess
import sys

from python.cli.command import both_modes, environment, objects


@both_modes
def test_a_failing_protocol(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", mode, "-r", "0")
    assert done.returncode == 1
    lines = done.stderr.splitlines()
    assert lines[0] == "Traceback (most recent call last):"
    assert "protocol.py" in lines[1]
    assert lines[-2] == "RuntimeError: spoilt"
    assert "in handle_packet of node 1 (Failing 1) at 1" in lines[-1]


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
    assert "in handle_packet of node 1 (Failing 1) at 1" in done.stdout.splitlines()[-1]


@both_modes
def test_what_it_computed_until_then_is_shown(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", mode)
    assert "interrupted at 1" in done.stdout
    assert "said = 1" in done.stdout


@both_modes
def test_the_runs_after_it_are_not_begun_and_that_is_said(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Failing", "--mode", mode, "--json")
    assert done.stderr.splitlines()[-1] == (
        "Failing: run 0 failed, 0 of 3 runs are done, 2 were not begun (1..2)"
    )
    assert [(run["run"], run["interrupted"]) for run in objects(done.stdout)] == [(0, True)]


@both_modes
def test_a_protocol_that_cannot_be_made(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "Unmakeable", "--mode", mode)
    assert done.returncode == 1
    assert "RuntimeError: no constructor" in done.stderr
    assert "node 0 (Unmakeable 0)" in done.stderr
    assert done.stdout == ""
