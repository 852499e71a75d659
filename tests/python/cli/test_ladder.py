"""`gradysim ladder`, `bisect` and `desync` on two UAVs that talk."""

import json
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
    assert levels == ["ideal", "range", "airtime", "access", "radio", "interference", "capture", "noise"]
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
    assert f"`{suggestion}`" in done.stderr
    assert done.returncode == MISTAKE


def test_a_protocol_that_fails_is_told_with_level_and_run(gradysim: Gradysim) -> None:
    done = gradysim(*LADDER, "-c", "Failing")
    assert all(part in done.stderr for part in ("level 0,", "run 0:", "spoilt", "(Failing 1) at 1 s"))
    assert done.stdout.count("failed") == 8
    assert done.returncode == FAILED


def test_bisect_names_the_exception_of_a_protocol(gradysim: Gradysim) -> None:
    done = gradysim("bisect", "test.ini", "-c", "Failing", "--assert", "uavs[*] said >= 1", "-j", "1")
    assert "spoilt" in done.stdout
    assert not done.stderr
    assert done.returncode == FAILED


def test_json_has_the_runs_of_each_level(gradysim: Gradysim) -> None:
    ladder = json.loads(gradysim(*LADDER, "--json").stdout)
    assert [level["metric"]["mean"] for level in ladder["levels"]] == [10] * 8
    arguments = "--assert", "uavs[*] said >= 10 and events > 0", "--max-runs", "24", "--json", "-j", "1"
    found = json.loads(gradysim("bisect", "test.ini", *arguments).stdout)
    assert (found["holds"], found["fails"], found["runs"]) == (True, None, 24)
    assert [(level["held"], level["runs"]) for level in found["levels"]] == [(3, 3)] * 8


def test_runs_that_are_kept_are_found_by_each_command(gradysim: Gradysim, folder: Path) -> None:
    first = gradysim(*LADDER, "--result-dir", "kept")
    file = folder / "kept" / "General.runs.jsonl"
    assert len(file.read_text(encoding="utf-8").split("\n")) == 2 * 8 + 1
    again = gradysim(*LADDER, "--result-dir", "kept", "--resume")
    assert again.stdout == first.stdout
    bisect = "bisect", "test.ini", "--assert", "uavs[*] said >= 10", "--max-runs", "16", "-j", "1"
    gradysim(*bisect, "--result-dir", "kept", "--resume")
    lines = [line for line in file.read_text(encoding="utf-8").splitlines() if line]
    assert len(lines) == 2 * 8


def test_resume_needs_a_directory(gradysim: Gradysim) -> None:
    done = gradysim(*LADDER, "--resume")
    assert "--result-dir DIR" in done.stderr
    assert done.returncode == MISTAKE


def test_the_exit_code_of_bisect_tells_whether_it_works(gradysim: Gradysim, folder: Path) -> None:
    works = gradysim("bisect", "test.ini", "--assert", "uavs[*] said >= 10", "--max-runs", "24", "-j", "1")
    assert works.returncode == OK
    assert " 8 levels" in works.stdout
    fails = gradysim("bisect", "test.ini", "--assert", "uavs[*] said >= 11", "-j", "1")
    assert fails.returncode == FAILED


def test_an_assertion_has_a_relation(gradysim: Gradysim) -> None:
    done = gradysim("bisect", "test.ini", "--assert", "uavs[*] said")
    assert "QUANTITY >= NUMBER" in done.stderr
    assert done.returncode == MISTAKE


def test_desync_names_runs_that_fail(gradysim: Gradysim) -> None:
    done = gradysim("desync", "test.ini", "-c", "Failing", "-n", "2")
    assert done.stdout.count("spoilt") == 2
    assert (done.stderr, done.returncode) == ("", FAILED)


def test_desync_prints_an_object_for_other_programs(gradysim: Gradysim) -> None:
    done = gradysim("desync", "test.ini", "-c", "Failing", "-n", "2", "--json")
    plain = json.loads(done.stdout)
    assert plain["jitter_s"] is None
    assert [each["exception"] for each in plain["failures"].values()] == ["RuntimeError"] * 2
    assert done.returncode == FAILED


def test_nothing_is_delayed_if_nothing_clashes(gradysim: Gradysim) -> None:
    done = gradysim("desync", "test.ini", "-n", "1")
    assert " 20 receptions" in done.stdout
    assert done.returncode == OK


@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGINT, INTERRUPTED), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]
)
def test_a_signal_ends_a_command_at_once_with_all_of_its_processes(
    folder: Path, number: signal.Signals, code: int
) -> None:
    command = [sys.executable, "-m", "gradysim", *LADDER, "-c", "Endless", "--result-dir", "kept"]
    with subprocess.Popen(
        command, cwd=folder, env=environment(), stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        assert process.stderr is not None
        while "ready" not in (line := process.stderr.readline()):
            assert line, "it ended before it was ready"
        os.kill(process.pid, number)
        _, error_output = process.communicate(timeout=30)
    assert process.returncode == code
    assert "kept/Endless.runs.jsonl" in error_output
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
