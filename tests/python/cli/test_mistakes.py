"""Messages about errors of the user."""

import shlex
import textwrap

import pytest

from gradysim.integrated import network
from python.cli.command import LINE_OF_THE_WRONG_KEY, both_modes, compiled, run_without
from python.golden import check_golden


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


COMMANDS = [
    "new",
    "nonsense",
    "run",
    "run missing.ini",
    "run test.ini First",
    "run test.ini --nonsense",
    "run test.ini --mode other",
    "run test.ini -c Missing",
    "run test.ini -r x",
    "run test.ini -r 7",
    "run test.ini --set nonsense",
    "run test.ini --set a=1 *.n[*].b=2",
    "run test.ini --result-dir test.ini",
    "run test.ini --seed 1.5",
    "run test.ini --seed 9223372036854775806",
    "run test.ini --jobs two",
    "run test.ini --jobs 1e3",
    "run test.ini --jobs 0",
    "run test.ini --memory 2",
    "run test.ini --share 4/3",
    "run test.ini --stop-after 5",
    "run test.ini --trace uavs[7]",
    "run test.ini --pcap uavs[7]",
    "run test.ini --pcap all --mode prototype",
    "run test.ini --outcomes-at all --mode prototype",
    "run test.ini --resume",
    "run test.ini --until 'ci(uavs[*] said) < 5%'",
    "runs missing.ini",
    "status nowhere test.ini",
    "verify nowhere",
    "pack nowhere",
    "means test.ini",
    "keys sensitivty",
    "docs fly-a-misson",
    "import missing.ini",
    "bisect test.ini --assert 'uavs[*] said'",
    "calibrate test.ini --range -5m",
    "calibrate test.ini --range 0m",
    "calibrate test.ini --range 50kmm",
    "calibrate test.ini --range 5s",
    "calibrate test.ini --range 50m --ratio 90",
    "calibrate test.ini --range 50m --ratio 100",
    "calibrate test.ini --range 50m --ratio 1",
    "calibrate test.ini --range 50m --ratio 0",
    "calibrate test.ini --range 50m --message -5B",
    "calibrate test.ini --range 50m --message 50.4B",
    "calibrate test.ini --range 50m --sender uavs",
]
"""Commands that are refused. `make golden` writes their messages to `tests/golden/commands.txt`."""


@compiled
def test_messages_are_those_of_the_golden_file(gradysim):
    told = ""
    for command in COMMANDS:
        done = gradysim(*shlex.split(command))
        assert (done.returncode, done.stdout) == (2, ""), command
        told += f"gradysim {command}\n{textwrap.indent(done.stderr, '    ')}\n"
    assert "Traceback" not in told
    check_golden("commands.txt", told)


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
