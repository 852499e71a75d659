from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.runs import UnreadVariables
from python.scenario.conftest import BASE

RTS = "**.rtsThreshold = ${rts=3000B, 100B}\n"
IN_FULL = "**.mac.dcf.rtsPolicy.rtsThreshold=100B"
BOATS = '**.boats[*].protocol.class = "protocols.py:Sensor"\n'


def unread(folder: Any, added: str, *overrides: str, runs: str | None = None) -> list[UnreadVariables]:
    """Those of the base with some lines more; each run says the same."""
    folder.write("test.ini", BASE + added)
    first, *others = load_scenarios(folder.ini, runs=runs, overrides=overrides)
    assert all(other.unread_variables == first.unread_variables for other in others)
    return list(first.unread_variables)


@pytest.mark.parametrize(
    ("study", "override"),
    [
        ("**.rtsThreshold = ${v=3000B, 100B}", IN_FULL),
        ("*.uavs[1].mobility.speed = ${v=1, 2}mps", "*.uavs[*].mobility.speed=3mps"),
        ("*.radioMedium.backgroundNoise.power = ${v=-90, -80}dBm", "*.radioMedium.**.power=-86dBm"),
        ("*.uavs[*].protocol.retries = ${v=1, 2}", "**.retries=3"),
    ],
)
def test_a_study_that_another_key_overrides(folder: Any, study: str, override: str) -> None:
    (variables,) = unread(folder, f"{study}\n", override)
    assert (variables.source.line, variables.names) == (6, ("v",))
    assert variables.instead is not None
    assert f"{variables.instead.key}={variables.instead.value}" == override


def test_the_line_in_force_is_told_from_lines_about_other_things(folder: Any) -> None:
    study = "*.uavs[1].mobility.speed = ${v=1, 2}mps\n"
    (variables,) = unread(folder, study, "**.bitrate=2Mbps", "*.uavs[*].mobility.speed=3mps")
    assert variables.instead is not None
    assert variables.instead.key == "*.uavs[*].mobility.speed"


@pytest.mark.parametrize(
    ("study", "override"),
    [
        (f"*.numBoats = ${{v=1, 2}}\n{BOATS}", "*.boats.count=1"),
        ("*.uavs[*].mobility.initialX = ${v=1m, 2m}\n", "*.uavs[*].mobility.lineStartX=5m"),
        ("*.uavs[*].mobility.lineStepX = ${v=1m, 2m}\n", "**.initialX=5m"),
        ("*.uavs[*].mobility.separationX = ${v=1m, 2m}\n", "**.initialX=5m"),
        ("*.uavs[*].mobility.initialX = ${v=1m, 2m}\n", "**.uavs[*].mobility.separationX=5m"),
        ("**.channelNumber = ${v=1, 5}\n", "**.centerFrequency=2.422GHz"),
        ("*.uavs[*].mobility.speed = ${v=1, 2}mps\n", "**.mobility.speed=default"),
    ],
)
def test_a_study_that_a_key_for_the_same_thing_overrides(folder: Any, study: str, override: str) -> None:
    (variables,) = unread(folder, study, override)
    assert (variables.source.line, variables.names) == (6, ("v",))


@pytest.mark.parametrize(
    "lines",
    [
        "**.power = ${p=1mW, 2mW}\n",
        "*.uavs[*].mobility.lineStepX = ${v=1m, 2m}\n",
        "*.uavs[*].mobility.separationX = ${v=1m, 2m}\n*.uavs[*].mobility.initialY = ${w=1m, 2m}\n",
        "description = ${text=one, two}\n",
        f"*.numBoats = ${{n=0, 1}}\n{BOATS}**.boats[*].mobility.speed = ${{v=1, 2}}mps\n",
        f"*.numBoats = ${{n=0, 1}}\n{BOATS}*.boats[0].mobility.speed = ${{v=1, 2}}mps\n",
    ],
)
def test_what_some_run_reads(folder: Any, lines: str) -> None:
    assert unread(folder, lines) == []


@pytest.mark.parametrize(
    "line",
    [
        "**.retries = ${rts} > 100B ? 1 : 2",
        "*.uavs[*].mobility.speed = ${v=1, 2 ! rts}mps",
        "**.label = ${iterationvars}",
        "seed-set = ${rts} > 100B ? 1 : 2",
    ],
)
def test_a_variable_that_another_line_refers_to_makes_runs_differ(folder: Any, line: str) -> None:
    assert unread(folder, RTS + f"{line}\n".replace("${iterationvars}", '"${iterationvars}"'), IN_FULL) == []


@pytest.mark.parametrize(
    "line",
    [
        "constraint = $rts > 0B",
        "iteration-nesting-order = rts",
        "experiment-label = ${rts}",
        "**.sigma = ${rts} > 0B ? 1 : 2\n**.pathLoss.sigma = 1",
    ],
)
def test_a_line_that_nothing_in_a_run_follows_from_does_not(folder: Any, line: str) -> None:
    override = (IN_FULL, "*.radioMedium.pathLoss.sigma=3") if "sigma" in line else (IN_FULL,)
    (variables,) = unread(folder, f"{RTS}{line}\n", *override)
    assert variables.names == ("rts",)


def test_an_override_with_the_same_key_leaves_no_variable(folder: Any) -> None:
    assert unread(folder, RTS, "**.rtsThreshold=100B") == []


def test_a_single_value_makes_no_runs_that_are_alike(folder: Any) -> None:
    assert unread(folder, "**.rtsThreshold = ${rts=3000B}\n", IN_FULL) == []


def test_several_variables_of_a_line_are_told_together(folder: Any) -> None:
    (variables,) = unread(folder, "**.rtsThreshold = ${a=1, 2}B * ${2, 3}\n", IN_FULL)
    assert variables.names == ("a", "0")


def test_of_some_of_the_runs_nothing_is_said(folder: Any) -> None:
    assert unread(folder, RTS, IN_FULL, runs="0") == []
