"""Messages about errors of the user."""

import pytest

from gradysim.integrated import network
from python.cli.command import LINE_OF_THE_WRONG_KEY, both_modes, compiled, run_without


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


@compiled
def test_a_mistake_that_only_the_whole_network_shows_is_found_before_a_single_run(gradysim):
    done = gradysim("run", "test.ini", "-c", "LateMistake", "-r", "2")
    assert (done.returncode, done.stdout) == (2, "")
    assert "cwMin = 20000 * ${runnumber}: " in done.stderr
    assert "Traceback" not in done.stderr


@compiled
@pytest.mark.parametrize(("runs", "checked"), [("0", 0), ("0..2", 1)])
def test_a_single_network_is_not_built_before_its_run(gradysim, monkeypatch, runs, checked):
    built = []  # in this process, not in the processes of the runs

    def build_network(scenario, build=network.build_network):
        built.append(scenario)
        return build(scenario)

    monkeypatch.setattr(network, "build_network", build_network)
    assert gradysim("run", "test.ini", "-r", runs, "--quiet").returncode == 0
    assert len(built) == checked


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


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["run", "test.ini", "First"], "First is one argument too many; expected an option before it"),
        (["run", "test.ini", "First"], "gradysim run --help"),
        (["run", "test.ini", "--set", "a=1", "*.n[*].b=2"], "*.n[*].b=2 is one argument too many"),
        (["run", "test.ini", "--set", "a=1", "*.n[*].b=2"], "expected --set before each KEY=VALUE"),
    ],
)
def test_an_argument_that_nothing_takes_is_named_with_what_is_missing(gradysim, arguments, text):
    done = gradysim(*arguments)
    assert done.returncode == 2
    assert text in " ".join(done.stderr.replace("│", "").split())


@pytest.mark.parametrize("option", ["--seed", "--jobs"])
@pytest.mark.parametrize("value", ["1.5", "1e3", "two"])
def test_a_number_that_is_not_whole_is_not_rounded(gradysim, option, value):
    done = gradysim("run", "test.ini", "--mode", "prototype", option, value)
    assert (done.returncode, done.stdout) == (2, "")
    assert f"{option}: {value} " in done.stderr


@compiled
@pytest.mark.parametrize(
    ("arguments", "refusal"),
    [
        (
            ["--range", "-5m"],
            "--range -5m: it is out of range; expected a length such as 50m, greater than 0m",
        ),
        (["--range", "0m"], "--range 0m: it is out of range; expected a length such as 50m, greater than 0m"),
        (
            ["--range", "50m", "--ratio", "90"],
            "--ratio 90: it is out of range; expected more than 0 and less than 1; did you mean 0.9?",
        ),
        (
            ["--range", "50m", "--ratio", "100"],
            "--ratio 100: it is out of range; expected more than 0 and less than 1",
        ),
        (
            ["--range", "50m", "--ratio", "1"],
            "--ratio 1: it is out of range; expected more than 0 and less than 1",
        ),
        (
            ["--range", "50m", "--ratio", "0"],
            "--ratio 0: it is out of range; expected more than 0 and less than 1",
        ),
        (
            ["--range", "50m", "--message", "-5B"],
            "--message -5B: it is out of range; expected a size such as 100B, at least 0B",
        ),
        (
            ["--range", "50m", "--message", "50.4B"],
            "--message 50.4B: `50.4B` is not an integer number of bytes;"
            " expected a size such as 100B, at least 0B",
        ),
        (
            ["--range", "50kmm"],
            "--range 50kmm: there is no unit `kmm`; expected a length such as 50m, greater than 0m;"
            " did you mean `mm`?",
        ),
        (
            ["--range", "5s"],
            "--range 5s: `s` is the unit of a time; expected a length such as 50m, greater than 0m",
        ),
    ],
)
def test_a_quantity_of_calibrate_is_refused_for_what_it_is(gradysim, arguments, refusal):
    done = gradysim("calibrate", "test.ini", *arguments)
    assert (done.returncode, done.stdout, done.stderr.strip()) == (2, "", refusal)


@compiled
def test_calibrate_reads_the_configuration_that_was_asked_for(gradysim):
    done = gradysim("calibrate", "test.ini", "-c", "WrongKey", "--range", "50m")
    assert (done.returncode, done.stdout) == (2, "")
    assert f"test.ini:{LINE_OF_THE_WRONG_KEY}" in done.stderr


@compiled
def test_where_a_picture_cannot_be_nothing_is_calculated(gradysim):
    pytest.importorskip("matplotlib")
    done = gradysim("calibrate", "test.ini", "--range", "50m", "--picture", "nowhere/curve.png")
    assert (done.returncode, done.stdout) == (2, "")
    assert "--picture nowhere/curve.png: " in done.stderr


@pytest.mark.parametrize("arguments", [["run", "test.ini"], ["calibrate", "test.ini", "--range", "50m"]])
def test_integrated_mode_without_the_compiled_part_says_how_to_get_it(folder, arguments):
    done = run_without("gradysim._netsim", folder, *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert "`pip install .`" in done.stderr
    assert "Traceback" not in done.stderr


def test_prototype_mode_needs_no_compiled_part(folder):
    done = run_without("gradysim._netsim", folder, "run", "test.ini", "--mode", "prototype")
    assert done.returncode == 0


@compiled
def test_a_picture_without_matplotlib_says_how_to_get_it(folder):
    picture = ("--picture", "curve.svg")
    done = run_without("matplotlib.figure", folder, "calibrate", "test.ini", "--range", "50m", *picture)
    assert (done.returncode, done.stdout) == (2, "")
    assert "pip" in done.stderr
    assert "Traceback" not in done.stderr
