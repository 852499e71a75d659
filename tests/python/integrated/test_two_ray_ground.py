"""Two rays: nodes on the ground, where both cancel, and nodes far away, where they nearly do."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.integrated.network import medium_config
from gradysim.integrated.run import run
from gradysim.integrated.two_ray_ground import ground_hint
from gradysim.scenario import Scenario, load_scenarios


@pytest.fixture
def hint(make_scenario: Callable[..., Scenario]) -> Callable[..., str]:
    """`hint(*settings)`: the hint for two nodes with these settings."""

    def of(*settings: str) -> str:
        scenario = make_scenario("class Tested(Talker): pass", *settings)
        return ground_hint(medium_config(scenario), scenario.nodes)

    return of


def path_loss(name: str) -> str:
    return f'*.radioMedium.pathLoss.typename="{name}"'


@pytest.mark.parametrize("name", ["TwoRayGroundReflection", "TwoRayInterference"])
def test_all_that_are_on_the_ground_are_told(hint: Callable[..., str], name: str) -> None:
    text = hint(path_loss(name))
    assert text.startswith(f"with {name}, ")
    assert all(part in text for part in ("uavs[0] and 1 ", "z = 0m", "`*.uavs[0].mobility.initialZ = 1.5m`"))


def test_of_one_that_is_there_alone_no_others_are_told(hint: Callable[..., str]) -> None:
    text = hint(path_loss("TwoRayInterference"), "*.uavs[0].mobility.initialZ=2m")
    assert "uavs[1] starts " in text
    assert "`*.uavs[1].mobility" in text


@pytest.mark.parametrize(
    "settings",
    [
        [path_loss("TwoRayInterference"), "*.uavs[*].mobility.initialZ=2m"],
        [path_loss("FreeSpacePathLoss")],
        [path_loss("TwoRayInterference"), '*.radioMedium.typename="UnitDiskRadioMedium"'],
    ],
    ids=["in the air", "one ray", "no rays"],
)
def test_where_nothing_cancels_nothing_is_told(hint: Callable[..., str], settings: list[str]) -> None:
    assert hint(*settings) == ""


VERTICAL = '*.radioMedium.pathLoss.polarization="vertical"'


@pytest.mark.parametrize(
    ("settings", "delivered"),
    [
        (['*.radioMedium.pathLoss.polarization="horizontal"'], 0),
        (['*.radioMedium.pathLoss.polarization="vertical"'], 0),
        (
            [
                '*.radioMedium.pathLoss.polarization="vertical"',
                "*.radioMedium.pathLoss.inetVerticalSign=true",
            ],
            9,
        ),
        ([path_loss("TwoRayGroundReflection")], 0),
    ],
    ids=["horizontal", "vertical", "vertical as in INET", "limit"],
)
def test_at_500_m_a_low_radio_hears_nothing(tmp_path: Path, settings: list[str], delivered: int) -> None:
    (tmp_path / "far.ini").write_text(FAR)
    (scenario,) = load_scenarios(tmp_path / "far.ini", overrides=settings)
    result = run(scenario)
    assert result.outcomes["frames"]["broadcast"]["delivered"] == delivered


FAR = """
[General]
sim-time-limit = 9.5s
*.numTx = 1
*.numRx = 1
*.tx[*].protocol.typename = "BeaconProtocol"
*.rx[*].protocol.typename = "SinkProtocol"
*.*[*].mobility.initialZ = 1.2m
*.rx[*].mobility.initialX = 500m
*.radioMedium.pathLoss.typename = "TwoRayInterference"
*.radioMedium.pathLoss.epsilon_r = 5
*.radioMedium.backgroundNoise.power = -95dBm
**.wlan[*].radio.transmitter.power = 1mW
**.wlan[*].radio.receiver.sensitivity = -120dBm
**.wlan[*].bitrate = 6Mbps
"""
