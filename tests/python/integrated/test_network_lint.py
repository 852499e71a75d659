"""Lint checks of integrated mode, from the .ini file to the finding."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.integrated.network_lint import UnreadLines, lint_networks
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.errors import Source
from gradysim.scenario.lint import Finding
from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.sections import config_names
from gradysim.scenario.resolve.models import Chosen, unmet_choice
from python.thorough import some

CONFIGS = Path(__file__).parents[3] / "configs"
EXAMPLES = [
    case
    for file in sorted(CONFIGS.rglob("*.ini"))
    if "sim-time-limit" in file.read_text()  # other files are only included
    for case in some((file, config) for config in config_names(read_ini(file)))
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

Findings = Callable[..., list[Finding]]


@pytest.fixture
def findings(make_scenario: Callable[..., Scenario]) -> Findings:
    """`findings(*settings)`: findings for two nodes with these settings."""

    def of(*settings: str) -> list[Finding]:
        return lint_networks([make_scenario("class Tested(Talker): pass", *settings)])

    return of


DEFAULTS: dict[str, str | None] = {
    "medium.typename": "Ieee80211ScalarRadioMedium",
    "medium.path_loss": "FreeSpacePathLoss",
    "interface.typename": "Ieee80211Interface",
    "mac.rate_control": "",
}


def chosen(**others: str | None) -> Chosen:
    """Return the chosen models: `chosen(path_loss="RicianFading")`."""
    in_force = {short(target): name for target, name in DEFAULTS.items()} | others
    return lambda target: in_force[short(target)]


def short(target: str) -> str:
    return "interface" if target == "interface.typename" else target.partition(".")[2]


def line(number: int, key: str = "**.key", file: str = "a.ini") -> Source:
    return Source(Path(file), number, key, "1")


def unread(sources: dict[str, Source], in_force: Chosen) -> list[Finding]:
    """Return the findings for the effective lines of one node or the network."""
    lines = UnreadLines()
    for target, source in sources.items():
        lines.add(target, source, in_force, "uavs[*]")
    return list(lines.findings())


@pytest.mark.parametrize(
    ("target", "in_force", "lacking"),
    [
        ("medium.sigma_db", chosen(), "medium.path_loss"),
        ("medium.sigma_db", chosen(path_loss="LogNormalShadowing"), None),
        ("medium.sigma_db", chosen(typename="UnitDiskRadioMedium"), "medium.typename"),
        ("mac.rate_interval_s", chosen(), "mac.rate_control"),
        ("mac.rate_interval_s", chosen(rate_control=None), None),
        ("mac.rate_interval_s", chosen(interface="Ieee802154NarrowbandInterface"), "interface.typename"),
        ("mobility.initial_heading_rad", chosen(), None),
        ("protocol.speed", chosen(), None),
    ],
)
def test_the_outermost_choice_that_is_lacking(target: str, in_force: Chosen, lacking: str | None) -> None:
    choice = unmet_choice(target, in_force)
    assert (choice and choice.chosen_by) == lacking


def test_a_finding_names_the_choice_that_is_lacking() -> None:
    (finding,) = unread({"medium.sigma_db": line(7, "*.radioMedium.pathLoss.sigma")}, chosen())
    assert (finding.line, finding.key) == (7, "*.radioMedium.pathLoss.sigma")
    assert '`*.radioMedium.pathLoss.typename = "LogNormalShadowing"`' in finding.message
    assert '"FreeSpacePathLoss"' in finding.message


def test_the_choice_of_a_node_names_its_group() -> None:
    (finding,) = unread({"mac.rate_interval_s": line(3)}, chosen())
    choice = '`*.uavs[*].wlan[*].mac.dcf.rateControl.typename = "ArfRateControl" or "AarfRateControl"`'
    assert choice in finding.message


@pytest.mark.parametrize(
    ("key", "interface"),
    [
        ("*.uavs[*].wlan[1].mac.dcf.rateControl.interval", "wlan[1]"),
        ("**.wlan[1..3].mac.dcf.rateControl.interval", "wlan[1..3]"),
        ("**.wlan[..3].mac.dcf.rateControl.interval", "wlan[..3]"),
        ("**.wlan[*].mac.dcf.rateControl.interval", "wlan[*]"),
        ("**.rateControl.interval", "wlan[*]"),
    ],
)
def test_the_choice_names_the_interface_of_the_line(key: str, interface: str) -> None:
    (finding,) = unread({"mac.rate_interval_s": line(3, key)}, chosen())
    assert f"`*.uavs[*].{interface}.mac.dcf.rateControl.typename = " in finding.message


def test_lines_of_two_interfaces_are_two_findings() -> None:
    lines = {
        "mac.rate_interval_s": line(3, "**.wlan[0].mac.dcf.rateControl.interval"),
        "mac.increase_threshold": line(4, "**.wlan[1].mac.dcf.rateControl.increaseThreshold"),
    }
    assert [finding.line for finding in unread(lines, chosen())] == [3, 4]


def test_a_line_that_is_read_is_no_finding() -> None:
    assert unread({"medium.sigma_db": line(3)}, chosen(path_loss="LogNormalShadowing")) == []


@pytest.mark.parametrize("order", [1, -1])
def test_a_line_that_one_of_the_nodes_reads_is_no_finding(order: int) -> None:
    lines = UnreadLines()
    for in_force in [chosen(), chosen(rate_control="ArfRateControl")][::order]:
        lines.add("mac.rate_interval_s", line(3), in_force, "uavs[*]")
    assert list(lines.findings()) == []


def test_a_line_with_wildcards_is_read_by_one_of_its_keys() -> None:
    assert unread({"medium.sigma_db": line(3), "medium.alpha": line(3)}, chosen()) == []


def test_all_other_choices_are_named() -> None:
    lines = UnreadLines()
    for rate_control in ("MinstrelRateControl", ""):
        lines.add("mac.rate_interval_s", line(3), chosen(rate_control=rate_control), "uavs[*]")
    (finding,) = lines.findings()
    assert finding.message.endswith(' "" or "MinstrelRateControl"')


def test_lines_that_lack_the_same_choice_are_one_finding() -> None:
    targets = ("rate_interval_s", "increase_threshold", "decrease_threshold")
    (finding,) = unread(
        {f"mac.{target}": line(number) for number, target in enumerate(targets, start=4)}, chosen()
    )
    assert finding.line == 4
    assert " 5 and 6:" in finding.message


@pytest.mark.parametrize(
    ("other", "nor"),
    [
        (line(9), "nor line 9:"),
        (line(1, file="b.ini"), "nor line b.ini:1:"),
        (Source(Path("b.ini"), 0, "**.l01", "1", "--set"), "nor line --set **.l01=1:"),
    ],
)
def test_other_places_are_named(other: Source, nor: str) -> None:
    (finding,) = unread({"medium.l01_db": line(4), "medium.l02_db": other}, chosen())
    assert nor in finding.message


def test_a_few_lines_are_all_named() -> None:
    fields = ("use_acks", "max_frame_retries", "ack_wait_s", "sifs_s", "max_backoffs")
    (finding,) = unread({f"csma.{field}": line(number) for number, field in enumerate(fields, 1)}, chosen())
    assert " 2, 3, 4 and 5:" in finding.message


def test_many_lines_are_only_counted() -> None:
    fields = ("use_acks", "max_frame_retries", "ack_wait_s", "sifs_s", "max_backoffs", "cca_s")
    (finding,) = unread({f"csma.{field}": line(number) for number, field in enumerate(fields, 1)}, chosen())
    assert ", nor 5 " in finding.message


def test_what_one_run_of_a_study_reads_is_read(tmp_path: Path) -> None:
    file = tmp_path / "study.ini"
    file.write_text(
        '[General]\nsim-time-limit = 1s\n*.node.protocol.typename = "SinkProtocol"\n'
        '*.radioMedium.pathLoss.typename = ${"LogNormalShadowing", "RicianFading"}\n'
        "*.radioMedium.pathLoss.sigma = 6\n*.radioMedium.pathLoss.k = 6dB\n"
        "*.radioMedium.pathLoss.shapeFactor = 2\n"
    )
    (finding,) = lint_networks(load_scenarios(file))
    assert (finding.line, finding.key) == (7, "*.radioMedium.pathLoss.shapeFactor")
    assert finding.message.endswith(' "LogNormalShadowing" or "RicianFading"')


def test_a_band_at_an_802154_interface(findings: Findings) -> None:
    sensors = f'{UAVS}.wlan[*].typename="Ieee802154NarrowbandInterface"'
    (finding,) = findings(sensors, f'{RADIO}.bandName="5 GHz"')
    assert finding.key == f"{RADIO}.bandName"
    assert '.wlan[*].typename = "Ieee80211Interface"' in finding.message
    some = findings(sensors.replace("[*]", "[0]", 1), f'{RADIO}.bandName="5 GHz"')
    assert [finding for finding in some if "reads" in finding.message] == []


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
def test_a_line_is_unread_until_its_model_is_chosen(findings: Findings, setting: str, choice: str) -> None:
    chooser, _, name = choice.partition("=")
    (finding,) = findings(setting)
    assert finding.key == setting.partition("=")[0]
    assert f"`{chooser} = {name}" in finding.message
    assert finding.key not in [other.key for other in findings(setting, choice)]


def test_an_autopilot_that_does_not_fly(findings: Findings) -> None:
    (finding,) = findings(f'{UAVS}.mobility.autopilotPath="arducopter"')
    assert '`*.uavs[*].mobility.typename = "ArdupilotMobility"`' in finding.message


def test_speed_is_for_nodes_that_move(findings: Findings) -> None:
    assert findings(f"{UAVS}.mobility.speed=3mps") == []
    (finding,) = findings(f"{UAVS}.mobility.speed=3mps", f'{UAVS}.mobility.typename="StationaryMobility"')
    assert '`*.uavs[*].mobility.typename = "MasslessMobility", ' in finding.message


def test_the_delay_of_commands_is_not_for_autopilots(findings: Findings) -> None:
    delay, flown = f"{UAVS}.mobility.commandDelay=1s", f'{UAVS}.mobility.typename="ArdupilotMobility"'
    assert findings(delay) == []
    assert findings(f"{UAVS}.mobility.drag=0.5", flown) == []
    (finding,) = findings(delay, flown)
    assert '`*.uavs[*].mobility.typename = "MasslessMobility" or "QuadcopterMobility"`' in finding.message


def test_what_one_node_reads_is_no_finding(findings: Findings) -> None:
    assert (
        findings("**.rateControl.interval=30ms", '*.uavs[1].**.rateControl.typename="ArfRateControl"') == []
    )


def test_a_choice_of_a_single_node_does_not_count_for_a_line_of_another(
    findings: Findings,
) -> None:
    (finding,) = findings(
        "*.uavs[0].**.rateControl.interval=30ms", '*.uavs[1].**.rateControl.typename="ArfRateControl"'
    )
    assert finding.key == "*.uavs[0].**.rateControl.interval"


def test_a_model_that_is_turned_off_explicitly_is_no_finding(findings: Findings) -> None:
    assert findings("**.rateControl.interval=30ms", '**.rateControl.typename=""') == []


def test_a_medium_without_radios_is_one_finding(findings: Findings) -> None:
    (finding,) = findings(
        '*.radioMedium.typename="UnitDiskRadioMedium"',
        "**.communicationRange=50m",
        "*.radioMedium.pathLoss.alpha=3",
        f"{RADIO}.transmitter.power=1mW",
        f"{UAVS}.wlan[*].bitrate=6Mbps",
    )
    assert finding.message.endswith(' "UnitDiskRadioMedium"')


def test_obstacles_without_a_loss_are_one_finding(findings: Findings) -> None:
    (finding,) = findings(*BOX)
    assert "`*.radioMedium.obstacleLoss.typename =" in finding.message
    assert findings(*BOX, '*.radioMedium.obstacleLoss.typename="IdealObstacleLoss"') == []


def test_a_material_is_for_losses_that_depend_on_it(findings: Findings) -> None:
    wood = '*.environment.obstacle[0].material="wood"'
    (finding,) = findings(*BOX, wood, '*.radioMedium.obstacleLoss.typename="IdealObstacleLoss"')
    assert finding.key == "*.environment.obstacle[0].material"
    assert findings(*BOX, wood, '*.radioMedium.obstacleLoss.typename="DielectricObstacleLoss"') == []


def test_obstacles_of_a_file_count_too() -> None:
    (finding,) = lint_networks(load_scenarios(CONFIGS / "town/town.ini", "General", "0"))
    assert finding.key == "*.environment.obstacles"


def test_nodes_on_the_ground_under_two_rays(findings: Findings) -> None:
    chosen = '*.radioMedium.pathLoss.typename="TwoRayInterference"'
    (finding,) = findings(chosen, "*.radioMedium.pathLoss.epsilon_r=15")
    assert finding.key == chosen.partition("=")[0]
    assert "TwoRayInterference" in finding.message


def test_a_ground_that_hardly_reflects(findings: Findings) -> None:
    chosen = '*.radioMedium.pathLoss.typename="TwoRayInterference"'
    (finding,) = findings(chosen, "*.*[*].mobility.initialZ=2m", "*.*.mobility.initialZ=2m")
    assert finding.key == chosen.partition("=")[0]
    assert " 1.02" in finding.message


@pytest.mark.parametrize(("file", "config"), EXAMPLES, ids=lambda part: getattr(part, "stem", part))
def test_examples_have_no_findings(file: Path, config: str) -> None:
    assert lint_networks(load_scenarios(file, config, "0")) == []


IDEAL = '*.radioMedium.obstacleLoss.typename="IdealObstacleLoss"'


def test_obstacles_far_from_all_nodes(findings: Findings) -> None:
    (finding,) = findings(*BOX, IDEAL, "*.uavs[*].mobility.initialX=4000km")
    assert "4000 km" in finding.message
    assert findings(*BOX, IDEAL, "*.uavs[0].mobility.initialX=4000km") == []
    assert findings(*BOX, IDEAL, "*.uavs[*].mobility.initialX=90km") == []


@pytest.mark.parametrize("axis", ["X", "Y"])
@pytest.mark.parametrize("sign", ["", "-"])
@pytest.mark.parametrize(("distance", "count"), [("101km", 1), ("99km", 0)])
def test_obstacles_are_far_from_100_km_on_in_any_direction(
    findings: Findings, axis: str, sign: str, distance: str, count: int
) -> None:
    place = f"*.uavs[*].mobility.initial{axis}={sign}{distance}"
    assert len(findings(*BOX, IDEAL, place)) == count


def op_mode(nodes: str, mode: str) -> str:
    return f'*.{nodes}.wlan[*].opMode="{mode}"'


def test_stations_on_one_channel_without_a_common_mode(findings: Findings) -> None:
    (finding,) = findings(op_mode("uavs[0]", "g(erp)"), op_mode("uavs[1]", "b"))
    assert (finding.key, finding.source.value) == ("*.uavs[1].wlan[*].opMode", '"b"')
    assert '"g(erp)" and "b"' in finding.message


def test_the_line_is_named_where_the_other_mode_is_the_default(findings: Findings) -> None:
    (finding,) = findings(op_mode("uavs[0]", "a"))
    assert finding.key == "*.uavs[0].wlan[*].opMode"


@pytest.mark.parametrize(
    "settings",
    [
        (op_mode("uavs[0]", "b"),),  # the other node has g(mixed)
        (op_mode("uavs[*]", "a"),),
        (op_mode("uavs[0]", "a"), "*.uavs[0].wlan[*].radio.channelNumber=5"),
        (op_mode("uavs[0]", "a"), '*.radioMedium.typename="UnitDiskRadioMedium"'),
    ],
)
def test_stations_that_hear_each_other_or_nobody_are_no_finding(
    findings: Findings, settings: tuple[str, ...]
) -> None:
    assert not [finding for finding in findings(*settings) if finding.key.endswith("opMode")]


CHANNEL_5 = "*.uavs[0].wlan[*].radio.channelNumber=5"


def unreceived(finding: Finding) -> str:
    """Return the node or interface that no node can receive."""
    return finding.message.partition("no node can receive ")[2].partition(":")[0]


def test_nodes_on_different_channels(findings: Findings) -> None:
    first, second = findings(CHANNEL_5)
    assert (first.key, unreceived(first)) == ("*.uavs[0].wlan[*].radio.channelNumber", "uavs[0]")
    assert (second.key, unreceived(second)) == ("*.uavs[0].wlan[*].radio.channelNumber", "uavs[1]")
    assert "2437 MHz" in first.message
    assert "2412 MHz" in second.message


def test_nodes_that_receive_in_one_direction_only(findings: Findings) -> None:
    (finding,) = findings("*.uavs[0].wlan[*].radio.bandwidth=20MHz")
    assert (finding.key, unreceived(finding)) == ("*.uavs[0].wlan[*].radio.bandwidth", "uavs[1]")


def test_another_technology_is_another_channel(findings: Findings) -> None:
    found = findings('*.uavs[0].wlan[*].typename="Ieee802154NarrowbandInterface"')
    assert [unreceived(finding) for finding in found] == ["uavs[0]", "uavs[1]"]


def test_an_interface_that_shares_its_channel_with_no_other_node(findings: Findings) -> None:
    (finding,) = findings("*.uavs[0].numWlanInterfaces=2", "*.uavs[0].wlan[1].radio.channelNumber=5")
    assert (finding.key, unreceived(finding)) == (
        "*.uavs[0].wlan[1].radio.channelNumber",
        "wlan[1] of uavs[0]",
    )


def test_a_node_does_not_receive_its_own_interfaces(findings: Findings) -> None:
    found = findings("*.uavs[0].numWlanInterfaces=2", CHANNEL_5)
    assert [unreceived(finding) for finding in found] == ["uavs[0]", "uavs[1]"]


def test_a_wider_listener_hears_what_one_of_the_same_width_does_not(
    findings: Findings,
) -> None:
    widths = [f"*.uavs[{uav}].wlan[*].radio.bandwidth={20 + uav}MHz" for uav in range(3)]
    (finding,) = findings("*.numUavs=3", *widths)
    assert unreceived(finding) == "uavs[2]"


@pytest.mark.parametrize(
    "settings",
    [
        ("*.uavs[*].wlan[*].radio.channelNumber=5",),
        ("*.uavs[*].numWlanInterfaces=2", "*.uavs[*].wlan[1].radio.channelNumber=5"),
        (CHANNEL_5, '*.radioMedium.typename="UnitDiskRadioMedium"'),
        ("*.numUavs=1", CHANNEL_5),
    ],
)
def test_nodes_that_another_one_receives_and_a_node_alone(
    findings: Findings, settings: tuple[str, ...]
) -> None:
    assert not any(map(unreceived, findings(*settings)))


NARROWBAND = f'{UAVS}.wlan[*].typename="Ieee802154NarrowbandInterface"'
ACK_WAIT = f"{UAVS}.wlan[*].mac.macAckWaitDuration"


def test_an_ack_that_ends_after_the_wait(findings: Findings) -> None:
    (finding,) = findings(NARROWBAND, f"{ACK_WAIT}=500us")
    assert finding.key == ACK_WAIT
    assert "waits 500us" in finding.message
    assert " 544us " in finding.message


def test_a_rest_that_makes_acks_too_late(findings: Findings) -> None:
    (finding,) = findings(NARROWBAND, f"{UAVS}.wlan[*].mac.sifs=1ms")
    assert finding.key == f"{UAVS}.wlan[*].mac.sifs"
    assert "waits 560us" in finding.message
    assert " 1352us " in finding.message


@pytest.mark.parametrize(
    "settings",
    [
        [NARROWBAND, f"{ACK_WAIT}=545us"],
        [NARROWBAND, f"{ACK_WAIT}=500us", f"{UAVS}.wlan[*].mac.useMACAcks=false"],
    ],
    ids=["long enough", "no ACKs"],
)
def test_acks_in_time_or_none_at_all(findings: Findings, settings: list[str]) -> None:
    assert findings(*settings) == []
