"""`gradysim ladder`, `bisect` and `desync` on two UAVs that talk."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from gradysim.cli.errors import FAILED, INTERRUPTED, MISTAKE, OK
from gradysim.cli.ladder import text_of
from gradysim.results import Estimate
from python.cli.command import Gradysim, environment
from python.processes import session, wait_until

pytest.importorskip("gradysim._netsim")

LADDER = ("ladder", "test.ini", "--metric", "uavs[*] said", "-n", "2", "-j", "1")


def test_each_level_of_the_scenario_has_a_row(gradysim: Gradysim) -> None:
    done = gradysim(*LADDER)
    levels = [line.split()[1] for line in done.stdout.splitlines() if line[:1].isdecimal()]
    assert levels == ["ideal", "range", "airtime", "access", "interference", "capture", "noise"]
    assert done.returncode == OK


def test_levels_are_chosen_by_number_or_name(gradysim: Gradysim) -> None:
    done = gradysim(*LADDER, "--levels", "1..access")
    levels = [line.split()[1] for line in done.stdout.splitlines() if line[:1].isdecimal()]
    assert levels == ["range", "airtime", "access"]


@pytest.mark.parametrize(
    ("arguments", "suggestion"),
    [
        (("--metric", "uavs[*] said", "--levels", "0..inteference"), "interference"),
        (("--metric", "uavs[*] sad"), "uavs[*] said"),
    ],
)
def test_a_wrong_name_is_told_with_the_nearest_one(
    arguments: tuple[str, ...], suggestion: str, gradysim: Gradysim
) -> None:
    done = gradysim("ladder", "test.ini", "-n", "1", *arguments)
    assert f"did you mean `{suggestion}`?" in done.stderr
    assert done.returncode == MISTAKE


def test_a_protocol_that_fails_is_told_with_level_and_run(gradysim: Gradysim) -> None:
    done = gradysim(*LADDER, "-c", "Failing")
    assert "level ideal, run 0: RuntimeError: spoilt" in done.stderr
    assert done.returncode == FAILED


def test_the_exit_code_of_bisect_tells_whether_it_works(gradysim: Gradysim, folder: Path) -> None:
    works = gradysim("bisect", "test.ini", "--assert", "uavs[*] said >= 10", "-j", "1")
    assert works.returncode == OK
    fails = gradysim("bisect", "test.ini", "--assert", "uavs[*] said >= 11", "-j", "1")
    assert fails.returncode == FAILED


def test_an_assertion_has_a_relation(gradysim: Gradysim) -> None:
    done = gradysim("bisect", "test.ini", "--assert", "uavs[*] said")
    assert "QUANTITY >= NUMBER" in done.stderr
    assert done.returncode == MISTAKE


def test_nothing_is_delayed_if_nothing_clashes(gradysim: Gradysim) -> None:
    done = gradysim("desync", "test.ini", "-n", "1")
    assert "None of 20 receptions" in done.stdout
    assert done.returncode == OK


def test_ctrl_c_ends_a_command_at_once_with_all_of_its_processes(folder: Path) -> None:
    command = [sys.executable, "-m", "gradysim", *LADDER, "-c", "Endless"]
    with subprocess.Popen(
        command, cwd=folder, env=environment(), stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        assert process.stderr is not None
        while "ready" not in (line := process.stderr.readline()):
            assert line, "it ended before it was ready"
        os.kill(process.pid, signal.SIGINT)
        process.communicate(timeout=30)
    assert process.returncode == INTERRUPTED
    wait_until(lambda: not session(process.pid), 5)


@pytest.mark.parametrize(
    ("found", "text"),
    [
        (Estimate(-279.25, -279.5, -279), "-279.2 ± 0.25"),
        (Estimate(5815, 5815, 5815), "+5815 ± 0"),
        (Estimate(0.9, 0.555, 0.9975), "+0.9 [0.56, 1]"),
        (Estimate(0.5), "+0.5"),
    ],
)
def test_both_ends_of_an_interval_are_told_if_the_mean_is_not_in_its_middle(
    found: Estimate, text: str
) -> None:
    assert text_of(found, sign="+") == text
