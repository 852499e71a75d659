"""The levels of the ladder. Each adds one effect to the level before, in physical order.

A level is declared by the settings that leave its effect out. At level k, the effects of the levels above k
are left out, and everything else is as the scenario says. Random streams have a purpose each, so that levels
share positions, traffic and all draws that both of them make.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field

from gradysim.scenario.ini import Section
from gradysim.scenario.scenario import Scenario

UNIT_DISK = "UnitDiskRadioMedium"
_UNLIMITED = "1e9m"


def _always(scenario: Scenario) -> bool:
    return True


def _has_radios(scenario: Scenario) -> bool:
    chosen = scenario.medium.get("typename")
    return chosen is None or chosen.value != UNIT_DISK


def _takes_time(*timings: str) -> Callable[[Scenario], bool]:
    def applies(scenario: Scenario) -> bool:
        chosen = scenario.medium.get("timing")
        return _has_radios(scenario) or (chosen is not None and chosen.value in timings)

    return applies


def _path_loss_is(*names: str) -> Callable[[Scenario], bool]:
    def applies(scenario: Scenario) -> bool:
        chosen = scenario.medium.get("path_loss")
        return chosen is not None and chosen.value in names

    return applies


def _has_shadowing(scenario: Scenario) -> bool:
    sigma = scenario.medium.get("shadowing_standard_deviation_db")
    return _path_loss_is("LogNormalShadowing")(scenario) or (sigma is not None and float(sigma.value) > 0)


def _has_obstacles(scenario: Scenario) -> bool:
    chosen = scenario.medium.get("obstacle_loss")
    return bool(scenario.obstacles) and chosen is not None and bool(chosen.value)


def _has_antennas(scenario: Scenario) -> bool:
    return any(wlan.antenna for node in scenario.nodes for wlan in node.wlan)


def _has_autopilots(scenario: Scenario) -> bool:
    return any(node.autopilot is not None for node in scenario.nodes)


def _has_drifting_clocks(scenario: Scenario) -> bool:
    return any(node.drift_rate for node in scenario.nodes)


@dataclass(frozen=True)
class Level:
    """One level.

    Attributes:
        name: Its name.
        adds: What it adds to the level before.
        off: {key: value} of the settings without its effect.
        applies: Whether a scenario has the effect. Otherwise the level is left out.
        is_added: Whether it is a section `[Level NAME]` of the file, which adds lines to the scenario.
    """

    name: str
    adds: str
    off: Mapping[str, str] = field(default_factory=dict)
    applies: Callable[[Scenario], bool] = _always
    is_added: bool = False


_FREE_SPACE = {"*.radioMedium.pathLoss.typename": '"FreeSpacePathLoss"'}
_RADIO = "*.*.wlan[*].radio"

LEVELS = (
    Level("ideal", "nothing: messages arrive at once, everywhere"),
    Level(
        "range",
        "the range of the radio",
        {f"{_RADIO}.transmitter.communicationRange": _UNLIMITED},
    ),
    Level(
        "airtime",
        "time on the air and on the way",
        {"*.radioMedium.timing": '"instant"'},
        _takes_time("airtime", "channelAccess"),
    ),
    Level(
        "access",
        "waiting until the channel is free",
        {"*.radioMedium.timing": '"airtime"'},
        _takes_time("channelAccess"),
    ),
    Level(
        "interference",
        "collisions: overlapping frames are lost",
        {"*.radioMedium.typename": f'"{UNIT_DISK}"', "*.radioMedium.timing": '"channelAccess"'},
        _has_radios,
    ),
    Level(
        "capture",
        "survival of weaker interference",
        {
            f"{_RADIO}.receiver.collisionModel": '"overlap"',
            f"{_RADIO}.receiver.preambleDetection.typename": '""',
            f"{_RADIO}.receiver.frameCapture.typename": '""',
        },
        _has_radios,
    ),
    Level(
        "noise",
        "noise and bit errors",
        {
            f"{_RADIO}.receiver.errorModel.typename": '""',
            "*.radioMedium.backgroundNoise.typename": '"IsotropicScalarBackgroundNoise"',
            "*.radioMedium.backgroundNoise.power": "-300dBm",
        },
        _has_radios,
    ),
    Level(
        "shadowing",
        "a random gain of each link",
        {"*.radioMedium.pathLoss.sigma": "0", "*.radioMedium.shadowing.standardDeviation": "0dB"},
        _has_shadowing,
    ),
    Level(
        "fading",
        "gains that vary from frame to frame",
        _FREE_SPACE,
        _path_loss_is("RayleighFading", "RicianFading", "NakagamiFading"),
    ),
    Level(
        "ground",
        "reflection from the ground",
        _FREE_SPACE,
        _path_loss_is("TwoRayGroundReflection", "TwoRayInterference"),
    ),
    Level(
        "obstacles",
        "obstacles that weaken or block frames",
        {"*.radioMedium.obstacleLoss.typename": '""'},
        _has_obstacles,
    ),
    Level(
        "antennas",
        "antennas that prefer directions",
        {f"{_RADIO}.antenna.typename": '"IsotropicAntenna"'},
        _has_antennas,
    ),
    Level(
        "autopilot",
        "vehicles flown by ArduPilot",
        {"*.*.mobility.typename": '"MasslessMobility"'},
        _has_autopilots,
    ),
    Level(
        "clocks",
        "clocks that run fast or slow",
        {"*.*.clock.oscillator.driftRate": "0ppm"},
        _has_drifting_clocks,
    ),
)
"""The built-in levels, from the most ideal one to the scenario as it is."""


def levels_of(scenario: Scenario, sections: Mapping[str, Section]) -> tuple[Level, ...]:
    """Return the levels whose effects a scenario has, and then those of its file."""
    return (
        *(level for level in LEVELS if level.applies(scenario)),
        *(Level(name, _description(section), is_added=True) for name, section in sections.items()),
    )


def settings_without(left_out: Collection[str], levels: Sequence[Level]) -> list[str]:
    """Return the "KEY=VALUE" settings that leave out these effects, by the names of their levels.

    The most ideal one comes first, since the first line of a key counts.
    """
    return [
        f"{key}={value}" for level in levels if level.name in left_out for key, value in level.off.items()
    ]


def added_sections(effects: Collection[str], levels: Sequence[Level]) -> list[str]:
    """Return the names of the sections that these effects add."""
    return [level.name for level in levels if level.is_added and level.name in effects]


def _description(section: Section) -> str:
    written = next((entry.text for entry in section.entries if entry.key == "description"), "")
    return written.strip('"') or f"the lines of [Level {section.name}]"
