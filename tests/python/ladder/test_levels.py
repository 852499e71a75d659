from collections.abc import Callable

import pytest

from gradysim.ladder.campaign import Campaign
from gradysim.ladder.levels import LEVELS, settings_of, working

RADIO = ["ideal", "range", "airtime", "access", "radio", "interference", "capture", "noise"]
BOX = """
*.environment.numObstacles = 1
*.environment.obstacle[0].minX = 500m
*.environment.obstacle[0].maxX = 501m
*.environment.obstacle[0].minY = 0m
*.environment.obstacle[0].maxY = 1m
*.environment.obstacle[0].minZ = 0m
*.environment.obstacle[0].maxZ = 1m
"""
SHADOWED_FADING = """
*.radioMedium.pathLoss.typename = "RayleighFading"
*.radioMedium.shadowing.standardDeviation = 4dB
"""
IDEAL_OBSTACLES = '*.radioMedium.obstacleLoss.typename = "IdealObstacleLoss"\n'


def names(campaign: Campaign) -> list[str]:
    return [level.name for level in campaign.levels]


def test_the_default_radio_has_no_effect_beyond_noise(make_campaign: Callable[..., Campaign]) -> None:
    assert names(make_campaign()) == RADIO


@pytest.mark.parametrize(
    ("line", "added"),
    [
        ("*.radioMedium.otherSystems.power = -95dBm", ["others"]),
        ("*.radioMedium.otherSystems.power = 0W", []),
        ('*.radioMedium.pathLoss.typename = "LogNormalShadowing"', ["shadowing"]),
        ("*.radioMedium.shadowing.standardDeviation = 4dB", ["shadowing"]),
        ("*.radioMedium.shadowing.standardDeviation = 0dB", []),
        ('*.radioMedium.pathLoss.typename = "RayleighFading"', ["fading"]),
        (SHADOWED_FADING, ["shadowing", "fading"]),
        ('*.radioMedium.pathLoss.typename = "RicianFading"', ["fading"]),
        ('*.radioMedium.pathLoss.typename = "NakagamiFading"', ["fading"]),
        ('*.radioMedium.pathLoss.typename = "TwoRayInterference"', ["ground"]),
        ('*.radioMedium.pathLoss.typename = "TwoRayGroundReflection"', ["ground"]),
        ('*.radioMedium.pathLoss.typename = "BreakpointPathLoss"', []),
        (IDEAL_OBSTACLES + BOX, ["obstacles"]),
        (IDEAL_OBSTACLES, []),
        (BOX, []),
        ('*.nodes[1].wlan[*].radio.antenna.typename = "DipoleAntenna"', ["antennas"]),
        ("*.nodes[1].mobility.positionError = 1m", ["position"]),
        ("*.wind.speed = 5mps", []),  # nothing that it acts on
        ("*.nodes[1].mobility.commandDelay = 1s", []),  # a node that does not move
        ("*.nodes[1].computer.processingTime = 0.4ms", ["computer"]),
        ("*.nodes[1].computer.processingTimeSpread = 1", []),
        ("*.nodes[1].clock.oscillator.driftRate = 5ppm", ["clocks"]),
        ("*.nodes[1].clock.oscillator.driftRate = 0ppm", []),
    ],
)
def test_each_effect_of_the_scenario_is_a_level(
    make_campaign: Callable[..., Campaign], line: str, added: list[str]
) -> None:
    assert names(make_campaign(file=line)) == [*RADIO, *added]


@pytest.mark.parametrize(("delay", "added"), [("0.5s", ["commands"]), ("0s", [])])
def test_a_delay_of_commands_is_a_level(
    make_campaign: Callable[..., Campaign], delay: str, added: list[str]
) -> None:
    moves = '*.nodes[1].mobility.typename="MasslessMobility"'
    assert names(make_campaign(moves, f"*.nodes[1].mobility.commandDelay={delay}")) == [*RADIO, *added]


@pytest.mark.parametrize(
    ("timing", "expected"),
    [
        ("instant", ["ideal", "range"]),
        ("airtime", ["ideal", "range", "airtime"]),
        ("aloha", ["ideal", "range", "airtime", "interference"]),
        ("channelAccess", ["ideal", "range", "airtime", "access"]),
    ],
)
def test_a_unit_disk_has_no_radios(
    make_campaign: Callable[..., Campaign], timing: str, expected: list[str]
) -> None:
    disk = f'*.radioMedium.typename = "UnitDiskRadioMedium"\n*.radioMedium.timing = "{timing}"\n'
    campaign = make_campaign(file=disk + "**.transmitter.communicationRange = 100m\n", config="General")
    assert names(campaign) == expected


def test_sections_of_the_file_are_the_last_levels(make_campaign: Callable[..., Campaign]) -> None:
    file = (
        '[Level rain]\ndescription = "it rains"\n*.radioMedium.backgroundNoise.power = -90dBm\n[Level slow]\n'
    )
    campaign = make_campaign(file=file)
    assert names(campaign) == [*RADIO, "rain", "slow"]
    assert [level.adds for level in campaign.levels[-2:]] == ["it rains", "the lines of [Level slow]"]


ALL = frozenset(level.name for level in LEVELS)


def setting(key: str, *left_out: str) -> str | None:
    """Return the value of a key in the settings without some effects: the first one counts."""
    lines = [line.partition("=") for line in settings_of(ALL - set(left_out), LEVELS)]
    return next((value.strip('"') for name, _, value in lines if name == key), None)


@pytest.mark.parametrize(
    ("left_out", "timing", "typename"),
    [
        ((), None, None),
        (("radio",), None, None),  # the MAC needs radios
        (("interference",), "channelAccess", None),
        (("radio", "interference"), "channelAccess", "UnitDiskRadioMedium"),
        (("access",), "aloha", None),
        (("access", "radio"), "aloha", "UnitDiskRadioMedium"),
        (("access", "interference"), "airtime", None),
        (("airtime",), "instant", None),
        (("airtime", "radio"), "instant", "UnitDiskRadioMedium"),
        (("airtime", "access", "interference"), "instant", None),
    ],
)
def test_each_effect_can_be_left_out_alone(
    left_out: tuple[str, ...], timing: str | None, typename: str | None
) -> None:
    assert setting("*.radioMedium.timing", *left_out) == timing
    assert setting("*.radioMedium.typename", *left_out) == typename


def test_effects_that_are_not_left_out_have_no_settings() -> None:
    assert settings_of(ALL, LEVELS) == []
    assert settings_of(ALL - {"obstacles"}, LEVELS) == ['*.radioMedium.obstacleLoss.typename=""']


@pytest.mark.parametrize(
    ("left_out", "also"),
    [
        ("airtime", {"access", "interference", "capture"}),
        ("interference", {"capture"}),
        ("inertia", {"autopilot", "wind"}),
        ("range", set()),
        ("access", set()),
    ],
)
def test_effects_are_left_out_with_what_they_need(left_out: str, also: set[str]) -> None:
    assert working(ALL - {left_out}, LEVELS) == ALL - {left_out} - also


def test_what_a_scenario_does_not_have_is_not_needed() -> None:
    levels = [level for level in LEVELS if level.name != "radio"]
    assert "noise" in working({"noise"}, levels)


def test_each_level_turns_its_effect_off_in_the_scenario(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign(
        file='*.radioMedium.pathLoss.typename = "RicianFading"\n' + IDEAL_OBSTACLES + BOX
    )
    ideal, full = (campaign.scenario(campaign.effects_up_to(level), 0) for level in (0, 9))
    assert (ideal.medium["typename"].value, ideal.medium["timing"].value) == (
        "UnitDiskRadioMedium",
        "instant",
    )
    assert (ideal.medium["path_loss"].value, full.medium["path_loss"].value) == (
        "FreeSpacePathLoss",
        "RicianFading",
    )
    assert (ideal.medium["obstacle_loss"].value, full.medium["obstacle_loss"].value) == (
        "",
        "IdealObstacleLoss",
    )
    assert "typename" not in full.medium


def test_settings_without_an_effect_of_some_nodes_are_theirs(make_campaign: Callable[..., Campaign]) -> None:
    typename = "mobility.typename"
    one = make_campaign(f'*.nodes[1].{typename}="QuadcopterMobility"', "*.wind.gusts=1mps")
    assert names(one) == [*RADIO, "inertia", "wind"]
    massless = '"MasslessMobility"'
    assert one.levels[-2].off == {f"*.nodes[1].{typename}": massless}
    everywhere = make_campaign(f'*.nodes[*].{typename}="QuadcopterMobility"')
    assert everywhere.levels[-1].off == {f"*.nodes[*].{typename}": massless}


def test_an_autopilot_is_a_level_above_inertia(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign('*.nodes[2].mobility.typename="ArdupilotMobility"')
    assert names(campaign) == [*RADIO, "inertia", "autopilot"]
    below = campaign.scenario(campaign.all_effects - {"autopilot"}, 0)
    assert [node.is_quadcopter for node in below.nodes] == [False, False, True]
