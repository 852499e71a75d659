"""What docs/how-to/fly-with-inertia.md shows is what happens."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.cli.app import main
from gradysim.motion.flight_controller import STEP_S, Airframe, FlightController
from gradysim.motion.wind import Wind, WindAtVehicle
from gradysim.prototype.simulation import airframe_of
from gradysim.scenario.load import load_scenarios
from verification.test_field import duration_s

pytest.importorskip("gradysim._netsim")
pytest.importorskip("matplotlib")

GUIDE = "docs/how-to/fly-with-inertia.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def page(saved: Callable[..., Path]) -> Path:
    """Return the directory with the files of the page, which is the current one."""
    return saved(GUIDE, python="square.py", ini="square.ini")


@pytest.mark.verify
def test_its_commands_print_and_draw_what_it_shows(
    page: Path, code_blocks: CodeBlocks, shell: Callable[[str, Path], str], shows: Callable[..., None]
) -> None:
    shows(GUIDE, shell("".join(code_blocks(GUIDE, "sh")), page), part=True)
    assert (page / "results" / "inertia.png").stat().st_size


def test_prototype_mode_prints_the_same(
    page: Path, shows: Callable[..., None], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "square.ini", "--mode", "prototype"]) == 0
    shows(GUIDE, capsys.readouterr().out, part=True)


def test_its_second_configuration_gives_each_node_an_error(page: Path) -> None:
    (scenario,) = load_scenarios(page / "square.ini", "Errors")
    assert [node.mobility["position_error_m"].value for node in scenario.nodes] == [1.5, 1.5]


def test_its_measured_vehicle_takes_as_long(root: Path, tmp_path: Path) -> None:
    (tmp_path / "copter.ini").write_text(COPTER)
    (scenario,) = load_scenarios(tmp_path / "copter.ini")
    measured = airframe_of(scenario.nodes[0])
    speed_mps = float(scenario.nodes[0].mobility["speed_mps"].value)
    rows = re.findall(
        r"^\| ([\d.]+) m \| ([\d.]+) s \| ([\d.]+) s \| ([\d.]+) s \|",
        (root / "docs/how-to/fly-with-inertia.md").read_text(encoding="utf-8"),
        re.MULTILINE,
    )
    assert len(rows) == 3
    delay_s = float(scenario.nodes[0].mobility["command_delay_s"].value)
    for leg_m, in_the_field, here, by_default in (map(float, row) for row in rows):
        assert delay_s + duration_s(leg_m, speed_mps, measured) == pytest.approx(here, abs=0.006)
        assert duration_s(leg_m, 5.0, Airframe()) == pytest.approx(by_default, abs=0.006)
        assert here == pytest.approx(in_the_field, rel=0.03)


COPTER = """
[General]
sim-time-limit = 1s
*.numN = 1
*.n[*].protocol.typename = "SinkProtocol"
include as_measured_copter.ini
"""


def flown_m(start_m: float, target_m: float, vehicle: FlightController) -> list[float]:
    """Fly to a target on the x axis for 20 s. Return the distance from the start after each step."""
    vehicle.go_to((target_m, 0.0, 20.0))
    path = []
    for _ in range(round(20 / STEP_S)):
        vehicle.step()
        path.append(vehicle.position[0] - start_m)
    return path


def test_a_vehicle_brakes_as_it_says(root: Path) -> None:
    page = " ".join((root / GUIDE).read_text(encoding="utf-8").split())
    vehicle = FlightController((0.0, 0.0, 20.0), 10.0, WindAtVehicle(Wind(), 1, 0), airframe=Airframe())
    path = flown_m(0, 100, vehicle)
    arrived_s = next(step for step, flown in enumerate(path, 1) if flown > 99.8) * STEP_S
    assert f"it takes {arrived_s:.1f} s for 100 m" in page
    assert f"It overshoots the target by {100 * (max(path) - 100):.0f} cm" in page
    flown_m(100, 1000, vehicle)
    here_m = vehicle.position[0]
    (told_m,) = re.findall(r"it stops within (\d+) m", page)
    assert int(told_m) - 1 < max(flown_m(here_m, here_m, vehicle)) <= int(told_m)
