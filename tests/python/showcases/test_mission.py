"""Missions: there and back, when they start, and what is refused."""

import pytest

from python.showcases.conftest import Ran

FLIES = '*.uav.protocol.class = "gradysim.showcases.mission:FlyingProtocol"\n'


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ('*.uav.protocol.mission = "0 0 20, 100 0 20"', (100, 0, 20)),
        ('*.uav.protocol.mission = "0 0 20, 100 0 20, back"', (0, 0, 20)),
        ('*.uav.protocol.mission = "0 0 20, 100 0 20"\n*.uav.protocol.takeoff_time = 55s', (0, 0, 20)),
        ('*.uav.protocol.mission = "0 0 20, 50 0 20"\n*.uav.protocol.takeoff_time = -1s', (50, 0, 20)),
        ('*.uav.protocol.mission = ""', (0, 0, 0)),
    ],
)
def test_where_a_mission_ends(ran: Ran, lines: str, expected: tuple[float, float, float]) -> None:
    end = ran(f"{FLIES}{lines}\n*.uav.mobility.speed = 10mps", limit_s=56.9)["uav"].position
    assert end == pytest.approx(expected, abs=1)


@pytest.mark.parametrize("mission", ["0 0", "0 0 x", "0 0 inf", "back, 0 0 0"])
def test_what_is_not_a_mission(ran: Ran, mission: str) -> None:
    with pytest.raises(ValueError, match="waypoint"):
        ran(f'{FLIES}*.uav.protocol.mission = "{mission}"')
