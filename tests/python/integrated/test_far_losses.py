"""Path loss far away, which a replay has for receivers that distance alone leaves without a frame."""

from collections.abc import Callable

import pytest

from gradysim.integrated.ranges import far_losses
from gradysim.scenario.scenario import Scenario


@pytest.mark.parametrize(
    ("setting", "loss_at_1m_db", "exponent"),
    [
        ("*.radioMedium.pathLoss.alpha = 2", 40.1, 2.0),
        ("*.radioMedium.pathLoss.alpha = 3", 40.1, 3.0),
        ('*.radioMedium.pathLoss.typename = "BreakpointPathLoss"', 58.5 - 33 * 0.90309, 3.3),
    ],
)
def test_it_is_a_power_of_the_distance(
    make_scenario: Callable[..., Scenario], setting: str, loss_at_1m_db: float, exponent: float
) -> None:
    for far_loss in far_losses(make_scenario("class Tested(Quiet): pass", setting)):
        assert far_loss is not None
        assert far_loss.sensitivity_dbm == pytest.approx(-85)
        assert far_loss.loss_at_1m_db == pytest.approx(loss_at_1m_db, abs=0.1)
        assert far_loss.exponent == pytest.approx(exponent)
        assert not far_loss.is_mean


def test_with_fading_it_is_a_mean(make_scenario: Callable[..., Scenario]) -> None:
    fading = '*.radioMedium.pathLoss.typename = "RayleighFading"'
    assert all(
        each and each.is_mean for each in far_losses(make_scenario("class Tested(Quiet): pass", fading))
    )


@pytest.mark.parametrize(
    "setting", ['pathLoss.typename = "TwoRayInterference"', 'typename = "UnitDiskRadioMedium"']
)
def test_with_a_ground_or_without_powers_there_is_none(
    make_scenario: Callable[..., Scenario], setting: str
) -> None:
    settings = [f"*.radioMedium.{setting}", "*.uavs[*].mobility.initialZ = 10m"]
    if "UnitDisk" in setting:
        settings.append("**.communicationRange = 50m")
    assert set(far_losses(make_scenario("class Tested(Quiet): pass", *settings))) == {None}
