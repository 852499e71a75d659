"""What a user is told who made a mistake."""

import subprocess
import sys

import pytest

from python.cli.command import LINE_OF_THE_WRONG_KEY, both_modes, compiled, environment


def test_a_wrong_key_is_named_with_its_place(gradysim):
    done = gradysim("run", "test.ini", "-c", "WrongKey")
    assert done.returncode == 2
    assert f"test.ini:{LINE_OF_THE_WRONG_KEY}" in done.stderr
    assert "speed" in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""


@compiled
def test_a_value_that_the_engine_refuses_is_named_with_its_place(gradysim):
    done = gradysim("run", "test.ini", "--set", "*.uavs[*].wlan[*].bitrate = 7Mbps")
    assert done.returncode == 2
    assert "--set *.uavs[*].wlan[*].bitrate=7Mbps" in done.stderr
    assert "Traceback" not in done.stderr


@both_modes
def test_a_mistake_in_a_later_run_is_found_before_the_first_one(gradysim, mode):
    done = gradysim("run", "test.ini", "-c", "LateMistake", "--mode", mode)
    assert done.returncode == 2
    assert done.stdout == ""


@pytest.mark.parametrize(
    "arguments",
    [
        ["run"],
        ["run", "missing.ini"],
        ["run", "test.ini", "--mode", "other"],
        ["run", "test.ini", "-c", "Missing"],
        ["run", "test.ini", "-r", "x"],
        ["run", "test.ini", "-r", "7"],
        ["run", "test.ini", "--set", "nonsense"],
        ["run", "test.ini", "--nonsense"],
        ["run", "test.ini", "--result-dir", "test.ini"],
        ["runs", "missing.ini"],
        ["nonsense"],
    ],
)
def test_wrong_arguments(gradysim, arguments):
    done = gradysim(*arguments)
    assert done.returncode == 2
    assert done.stderr != ""
    assert "Traceback" not in done.stderr
    assert done.stdout == ""


def test_integrated_mode_without_the_compiled_part_says_how_to_get_it(folder):
    code = (
        "import sys; sys.modules['gradysim._netsim'] = None; from gradysim.cli import main; sys.exit(main())"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "run", "test.ini"],
        cwd=folder, env=environment(), capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 2
    assert "pip install ." in done.stderr


def test_prototype_mode_needs_no_compiled_part(folder):
    code = (
        "import sys; sys.modules['gradysim._netsim'] = None; from gradysim.cli import main; sys.exit(main())"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "run", "test.ini", "--mode", "prototype"],
        cwd=folder, env=environment(), capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0
