"""Warnings about valid lines that are probably not intended."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.cli.app import main
from gradysim.scenario import Scenario
from python.cli.command import both_modes

SIGMA = "*.radioMedium.pathLoss.sigma=3"


@pytest.fixture
def ini(make_scenario: Callable[..., Scenario], tmp_path: Path) -> str:
    make_scenario()
    return str(tmp_path / "test.ini")


def test_a_line_that_nothing_reads_is_told_once_for_all_runs(
    ini: str, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("gradysim._netsim")
    assert main(["run", ini, "--quiet", "--set", SIGMA, "--set", "repeat=3"]) == 0
    shown = capsys.readouterr()
    assert shown.err.count("warning") == 1
    assert f"--set {SIGMA}: " in shown.err
    assert "warning" not in shown.out


def test_prototype_mode_says_nothing_of_models_that_it_does_not_have(
    ini: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", ini, "--quiet", "--mode", "prototype", "--set", SIGMA]) == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("mode", ["integrated", "prototype"])
def test_a_line_below_one_that_fits_as_well_is_told_in_both_modes(
    ini: str, capsys: pytest.CaptureFixture[str], mode: str
) -> None:
    if mode == "integrated":
        pytest.importorskip("gradysim._netsim")
    with Path(ini).open("a", encoding="utf-8") as file:
        file.write("**.mobility.speed = 3mps\n*.uavs[0].mobility.speed = 5mps\n")
    assert main(["run", ini, "--quiet", "--mode", mode, "--set", "repeat=2"]) == 0
    assert capsys.readouterr().err.count("warning: `*.uavs[0].mobility.speed` ") == 1


def test_a_second_name_of_the_network_is_told(ini: str, capsys: pytest.CaptureFixture[str]) -> None:
    file = Path(ini)
    first, *rest = file.read_text("utf-8").splitlines()
    file.write_text("\n".join([first, "network = Network", "network = Other", *rest]), "utf-8")
    assert main(["run", ini, "--quiet", "--mode", "prototype"]) == 0
    error_output = capsys.readouterr().err
    assert all(part in error_output for part in (":3: ", "line 2, `network`"))


@pytest.mark.parametrize("command", ["run", "runs"])
def test_of_two_settings_with_one_key_the_second_is_told(
    ini: str, capsys: pytest.CaptureFixture[str], command: str
) -> None:
    options = ["--mode", "prototype", "--quiet"] if command == "run" else []
    settings = ["--set", "repeat=2", "--set", "seed-set=1", "--set", "repeat=3", "--set", "repeat = 2"]
    assert main([command, ini, *options, *settings]) == 0
    first = capsys.readouterr().err.splitlines()[0]
    assert first.startswith("--set repeat=3: ")
    assert "`--set repeat=2`" in first


@pytest.mark.parametrize(("medium", "told"), [("Ieee80211ScalarRadioMedium", 1), ("UnitDiskRadioMedium", 0)])
def test_a_range_beside_a_power_is_told_where_it_stands_for_one(
    ini: str, capsys: pytest.CaptureFixture[str], medium: str, told: int
) -> None:
    pytest.importorskip("gradysim._netsim")
    with Path(ini).open("a", encoding="utf-8") as file:
        file.write("**.transmitter.power = 20mW\n**.transmitter.communicationRange = 50m\n")
    assert main(["run", ini, "--quiet", "--set", f"*.radioMedium.typename={medium}"]) == 0
    assert capsys.readouterr().err.count("Range` ") == told


def test_a_time_in_meters_is_reported_once_for_all_runs(
    make_scenario: Callable[..., Scenario], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    make_scenario("class Tested(Talker): interval = 1.0")
    interval = "*.uavs[*].protocol.interval=5m"
    arguments = ["--mode", "prototype", "--set", "repeat=2", "--set", interval, "--quiet"]
    assert main(["run", str(tmp_path / "test.ini"), *arguments]) == 0
    assert capsys.readouterr().err.count("warning: `interval` ") == 1


@both_modes
def test_a_parameter_that_the_protocol_sets_itself_is_reported_once_for_all_runs(
    make_scenario: Callable[..., Scenario], tmp_path: Path, capsys: pytest.CaptureFixture[str], mode: str
) -> None:
    make_scenario("class Tested(Talker):\n    retries = 3\n    def __init__(self): self.retries = 5")
    setting = "**.retries=${2, 4}"
    assert main(["run", str(tmp_path / "test.ini"), "--mode", mode, "--set", setting, "--quiet"]) == 0
    assert capsys.readouterr().err.count(f"--set {setting}: warning: `retries` ") == 1


@both_modes
def test_a_list_that_nodes_share_is_reported_once_for_all_runs(
    make_scenario: Callable[..., Scenario], tmp_path: Path, capsys: pytest.CaptureFixture[str], mode: str
) -> None:
    make_scenario("class Tested(Talker):\n    known = []\n    def finish(self): self.known.append(1)")
    arguments = ["--mode", mode, "--set", "repeat=2", "--quiet"]
    assert main(["run", str(tmp_path / "test.ini"), *arguments]) == 0
    assert capsys.readouterr().err.count("warning: `known` ") == 1


def test_a_band_that_says_nothing_is_told_once_for_all_runs(gradysim):
    lines = ['*.uavs[*].wlan[*].radio.bandName="5 GHz"', "*.uavs[*].wlan[*].radio.centerFrequency=2.412GHz"]
    settings = [part for line in lines for part in ("--set", line)]
    done = gradysim("run", "test.ini", "--mode", "prototype", "--quiet", *settings)
    assert done.stderr.count(f"--set {lines[0]}: warning: ") == 1


@pytest.mark.parametrize("command", [["runs"], ["run", "--mode", "prototype", "--quiet"]])
def test_a_study_that_nothing_reads_is_told_once_for_all_runs(gradysim, folder, command):
    with (folder / "test.ini").open("a") as file:
        file.write("[Config Study]\n**.rtsThreshold = ${rts=3000B, 100B}\n")
    name, *options = command
    arguments = ["-c", "Study", "--set", "**.rtsPolicy.rtsThreshold=100B", *options]
    done = gradysim(name, "test.ini", *arguments)
    assert done.returncode == 0
    (warning,) = done.stderr.splitlines()
    assert all(
        part in warning for part in ("`**.rtsThreshold`", "$rts", "`--set **.rtsPolicy.rtsThreshold=100B`")
    )
