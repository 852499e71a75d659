"""The positions of stations do not affect whether their slots collide: at one point, on a line, anywhere."""

from pathlib import Path

import pytest

from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios

SATURATION = Path(__file__).resolve().parents[3] / "configs" / "reference" / "saturation.ini"


def lost_in_slots(*places: str) -> int:
    """Return the unicast frames that ten saturated stations lose by sharing a slot."""
    overrides = ["*.numStations = 10", "sim-time-limit = 2s", *places]
    (scenario,) = load_scenarios(SATURATION, "G54", overrides=overrides)
    outcomes = run(scenario).outcomes["frames"]["unicast"]
    return int(
        sum(outcomes[outcome] for outcome in ("interference", "receiver_locked", "receiver_transmitting"))
    )


@pytest.mark.parametrize(
    "places",
    [
        ["*.stations[*].mobility.lineStepY = 0m"],
        ["*.stations[*].mobility.lineStepX = 0.1m", "*.stations[*].mobility.lineStepY = 0m"],
    ],
    ids=["at one point", "on a line with the sink"],
)
def test_stations_collide_wherever_they_stand(places):
    assert lost_in_slots(*places) == pytest.approx(lost_in_slots(), rel=0.1)
