"""The output in docs/how-to/fly-with-ardupilot.md is correct."""

import shlex
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.cli.app import main
from gradysim.scenario import load_scenarios
from gradysim.simulator.handler.ardupilot_mobility import ArdupilotMobilityException

PAGE = "docs/how-to/fly-with-ardupilot.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def folder(code_blocks: CodeBlocks, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the directory with the guide's script, as a reader would save it.

    It is the working directory.
    """
    (tmp_path / "patrol.py").write_text("\n\n".join(code_blocks(PAGE, "python")))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def patrol(folder: Path, imported: Callable[[Path], Any]) -> Any:
    """The guide's script, imported."""
    return imported(folder / "patrol.py")


@pytest.mark.verify
def test_the_script_flies(
    patrol: Any, toy_copter: Callable[..., Path], monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    program = toy_copter()
    monkeypatch.setenv("GRADYSIM_ARDUPILOT", str(program))
    configuration = patrol.ArdupilotMobilityConfiguration
    monkeypatch.setattr(
        patrol,
        "ArdupilotMobilityConfiguration",
        lambda **settings: configuration(autopilot_user=None, simulation_startup_speedup=50, **settings),
    )
    for real_time in (0, 10):
        assert patrol.patrol(14, real_time) == pytest.approx((40, 0, 15), abs=1.5)
    assert (folder / "ardupilot_mobility_report.csv").exists()


@pytest.mark.verify
def test_the_file_flies_the_same_in_both_modes(
    folder: Path, toy_copter: Callable[..., Path], code_blocks: CodeBlocks, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GRADYSIM_ARDUPILOT", str(toy_copter()))
    (text,) = code_blocks(PAGE, "ini")
    (folder / "flight.ini").write_text(text)
    own_user = '*.uavs[*].mobility.autopilotUser = ""'
    (scenario,) = load_scenarios(folder / "flight.ini", overrides=[own_user, "sim-time-limit = 14s"])
    results = [run(scenario) for run in (gradysim.prototype.run.run, gradysim.integrated.run.run)]
    for here, there in zip(*(result.nodes for result in results), strict=True):
        assert here.position == pytest.approx((40, 0, 15), abs=1.5)
        assert here.tracked_variables["position"] == pytest.approx(
            there.tracked_variables["position"], abs=0.001
        )


@pytest.mark.verify
def test_the_commands_run(
    folder: Path,
    toy_copter: Callable[..., Path],
    code_blocks: CodeBlocks,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("GRADYSIM_ARDUPILOT", str(toy_copter()))
    (folder / "flight.ini").write_text(code_blocks(PAGE, "ini")[0])
    (commands,) = code_blocks(PAGE, "sh")
    variable, *runs = commands.splitlines()
    assert variable.startswith("export GRADYSIM_ARDUPILOT=")
    for command in runs:
        program, *arguments = shlex.split(command, comments=True)
        shorter = ["--set", "sim-time-limit=1s", "--set", '*.uavs[*].mobility.autopilotUser=""']
        assert (program, main([*arguments, *shorter])) == ("gradysim", 0)
    assert capsys.readouterr().out.count("uavs[1]") == len(runs) == 2


@pytest.mark.verify
def test_a_failure_is_told_in_the_words_of_the_guide(
    patrol: Any, toy_copter: Callable[..., Path], code_blocks: CodeBlocks
) -> None:
    program = toy_copter({1: {"refuse_arming": True}})
    configuration = patrol.ArdupilotMobilityConfiguration(
        ardupilot_path=program, autopilot_user=None, uav_api_startup_timeout=2
    )
    builder = patrol.SimulationBuilder(patrol.SimulationConfiguration(real_time=True))
    builder.add_handler(patrol.TimerHandler())
    builder.add_handler(patrol.ArdupilotMobilityHandler(configuration))
    for x in (0, 10):
        builder.add_node(patrol.Patrol, (x, 0, 10))
    with pytest.raises(ArdupilotMobilityException) as caught:
        builder.build().start_simulation()
    (words,) = code_blocks(PAGE, "text")
    assert f"{caught.value}\n" == words


def test_its_types_hold(folder: Path, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(folder / "patrol.py") == ""
