"""What is allowed and seldom meant, from the .ini file to the text."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.integrated.scenario_warnings import scenario_warnings
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.file.reader import read_ini
from gradysim.scenario.file.sections import config_names

CONFIGS = Path(__file__).parents[3] / "configs"
EXAMPLES = [
    (file, config)
    for file in sorted(CONFIGS.rglob("*.ini"))
    if "sim-time-limit" in file.read_text()  # the others are only there to be included
    for config in config_names(read_ini(file))
]
UAVS = "*.uavs[*]"
RADIO = f"{UAVS}.wlan[*].radio"
DCF = f"{UAVS}.wlan[*].mac.dcf"
BOX = [
    "*.environment.numObstacles=1",
    *(
        f"*.environment.obstacle[0].{end}{axis}={value}m"
        for end, value in (("min", 1), ("max", 2))
        for axis in "XYZ"
    ),
]

MakeScenario = Callable[..., Scenario]


@pytest.fixture
def warnings(make_scenario: MakeScenario) -> Callable[..., list[str]]:
    """`warnings(*settings)`: the texts for two nodes with these settings."""

    def of(*settings: str) -> list[str]:
        return scenario_warnings([make_scenario("class Tested(Talker): pass", *settings)])

    return of


def test_what_one_run_of_a_study_reads_is_read(tmp_path: Path) -> None:
    file = tmp_path / "study.ini"
    file.write_text(
        '[General]\nsim-time-limit = 1s\n*.node.protocol.typename = "SinkProtocol"\n'
        '*.radioMedium.pathLoss.typename = ${"LogNormalShadowing", "RicianFading"}\n'
        "*.radioMedium.pathLoss.sigma = 6\n*.radioMedium.pathLoss.k = 6dB\n"
        "*.radioMedium.pathLoss.shapeFactor = 2\n"
    )
    (text,) = scenario_warnings(load_scenarios(file))
    assert "study.ini:7: warning: nothing reads `*.radioMedium.pathLoss.shapeFactor`" in text
    assert text.endswith('and it is "LogNormalShadowing" or "RicianFading"')


def test_a_band_at_an_802154_interface(warnings: Callable[..., list[str]]) -> None:
    sensors = f'{UAVS}.wlan[*].typename="Ieee802154NarrowbandInterface"'
    (text,) = warnings(sensors, f'{RADIO}.bandName="5 GHz"')
    assert f"nothing reads `{RADIO}.bandName`: that takes" in text
    assert '.wlan[*].typename = "Ieee80211Interface"' in text
    some = warnings(sensors.replace("[*]", "[0]", 1), f'{RADIO}.bandName="5 GHz"')
    assert [text for text in some if "nothing reads" in text] == []


@pytest.mark.parametrize(
    ("setting", "choice"),
    [
        ("*.radioMedium.pathLoss.sigma=3", '*.radioMedium.pathLoss.typename="LogNormalShadowing"'),
        (
            "*.radioMedium.backgroundNoise.temperature=3K",
            '*.radioMedium.backgroundNoise.typename="ThermalNoise"',
        ),
        (f"{RADIO}.antenna.beamWidth=30deg", f'{RADIO}.antenna.typename="CosineAntenna"'),
        (f"{RADIO}.antenna.offsetBank=30deg", f'{RADIO}.antenna.typename="DipoleAntenna"'),
        (f"{RADIO}.receiver.noiseFigure=3dB", '*.radioMedium.backgroundNoise.typename="ThermalNoise"'),
        (
            f"{RADIO}.receiver.preambleDetection.threshold=3dB",
            f'{RADIO}.receiver.preambleDetection.typename="ThresholdPreambleDetection"',
        ),
        (
            f"{RADIO}.receiver.frameCapture.margin=3dB",
            f'{RADIO}.receiver.frameCapture.typename="SimpleFrameCapture"',
        ),
        (f"{DCF}.rateControl.interval=30ms", f'{DCF}.rateControl.typename="ArfRateControl"'),
        (f"{UAVS}.wlan[*].mac.macMinBE=3", f'{UAVS}.wlan[*].typename="Ieee802154NarrowbandInterface"'),
    ],
)
def test_a_line_is_told_until_its_model_is_chosen(
    warnings: Callable[..., list[str]], setting: str, choice: str
) -> None:
    chooser, _, name = choice.partition("=")
    (text,) = warnings(setting)
    assert text.startswith(f"override {setting}: warning: nothing reads `{setting.partition('=')[0]}`")
    assert f"`{chooser} = {name}" in text
    assert [text for text in warnings(setting, choice) if "nothing reads" in text] == []


def test_an_autopilot_that_does_not_fly_is_told(warnings: Callable[..., list[str]]) -> None:
    (text,) = warnings(f'{UAVS}.mobility.autopilotPath="arducopter"')
    assert 'that takes `*.uavs[*].mobility.typename = "ArdupilotMobility"`' in text


def test_speed_is_for_those_who_move(warnings: Callable[..., list[str]]) -> None:
    assert warnings(f"{UAVS}.mobility.speed=3mps") == []
    (text,) = warnings(f"{UAVS}.mobility.speed=3mps", f'{UAVS}.mobility.typename="StationaryMobility"')
    assert 'that takes `*.uavs[*].mobility.typename = "MasslessMobility" or "ArdupilotMobility"`' in text


def test_what_one_node_reads_is_not_told(warnings: Callable[..., list[str]]) -> None:
    assert (
        warnings("**.rateControl.interval=30ms", '*.uavs[1].**.rateControl.typename="ArfRateControl"') == []
    )


def test_a_choice_of_a_single_node_does_not_count_for_a_line_of_another(
    warnings: Callable[..., list[str]],
) -> None:
    (text,) = warnings(
        "*.uavs[0].**.rateControl.interval=30ms", '*.uavs[1].**.rateControl.typename="ArfRateControl"'
    )
    assert "nothing reads `*.uavs[0].**.rateControl.interval`" in text


def test_what_is_turned_off_in_so_many_words_is_not_told(warnings: Callable[..., list[str]]) -> None:
    assert warnings("**.rateControl.interval=30ms", '**.rateControl.typename=""') == []


def test_a_medium_without_radios_is_told_once(warnings: Callable[..., list[str]]) -> None:
    (text,) = warnings(
        '*.radioMedium.typename="UnitDiskRadioMedium"',
        "**.communicationRange=50m",
        "*.radioMedium.pathLoss.alpha=3",
        f"{RADIO}.transmitter.power=1mW",
        f"{UAVS}.wlan[*].bitrate=6Mbps",
    )
    assert text.endswith('and it is "UnitDiskRadioMedium"')


def test_obstacles_without_a_loss_are_told_once(warnings: Callable[..., list[str]]) -> None:
    (text,) = warnings(*BOX)
    assert "other lines: that takes `*.radioMedium.obstacleLoss.typename =" in text
    assert warnings(*BOX, '*.radioMedium.obstacleLoss.typename="IdealObstacleLoss"') == []


def test_a_material_is_for_losses_that_depend_on_it(warnings: Callable[..., list[str]]) -> None:
    wood = '*.environment.obstacle[0].material="wood"'
    (text,) = warnings(*BOX, wood, '*.radioMedium.obstacleLoss.typename="IdealObstacleLoss"')
    assert "nothing reads `*.environment.obstacle[0].material`" in text
    assert warnings(*BOX, wood, '*.radioMedium.obstacleLoss.typename="DielectricObstacleLoss"') == []


def test_obstacles_of_a_file_count_too() -> None:
    (text,) = scenario_warnings(load_scenarios(CONFIGS / "town/town.ini", "General", "0"))
    assert "nothing reads `*.environment.obstacles`" in text


def test_nodes_on_the_ground_under_two_rays(warnings: Callable[..., list[str]]) -> None:
    chosen = '*.radioMedium.pathLoss.typename="TwoRayInterference"'
    (text,) = warnings(chosen)
    assert text.startswith(f"override {chosen}: warning: with TwoRayInterference, a node on the ground hears")


@pytest.mark.parametrize(("file", "config"), EXAMPLES, ids=lambda part: getattr(part, "stem", part))
def test_examples_have_no_such_lines(file: Path, config: str) -> None:
    assert scenario_warnings(load_scenarios(file, config, "0")) == []


IDEAL = '*.radioMedium.obstacleLoss.typename="IdealObstacleLoss"'


def test_obstacles_far_from_all_nodes_are_told(warnings: Callable[..., list[str]]) -> None:
    (text,) = warnings(*BOX, IDEAL, "*.uavs[*].mobility.initialX=4000km")
    assert "warning: all obstacles are 4000 km and more from where any node starts" in text
    assert warnings(*BOX, IDEAL, "*.uavs[0].mobility.initialX=4000km") == []
    assert warnings(*BOX, IDEAL, "*.uavs[*].mobility.initialX=90km") == []


@pytest.mark.parametrize("axis", ["X", "Y"])
@pytest.mark.parametrize("sign", ["", "-"])
@pytest.mark.parametrize(("distance", "told"), [("101km", 1), ("99km", 0)])
def test_obstacles_are_far_from_100_km_on_in_any_direction(
    warnings: Callable[..., list[str]], axis: str, sign: str, distance: str, told: int
) -> None:
    place = f"*.uavs[*].mobility.initial{axis}={sign}{distance}"
    assert len(warnings(*BOX, IDEAL, place)) == told
