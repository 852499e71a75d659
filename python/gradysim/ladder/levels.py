"""The levels of the ladder. Each adds one effect to the level before, in physical order.

A level is declared by the settings that leave its effect out. At level k, the effects of the levels above k
are left out, and everything else is as the scenario says. Random streams have a purpose each, so that levels
share positions, traffic and all draws that both of them make.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby

from gradysim.scenario.ini import Section
from gradysim.scenario.node_spec import NodeSpec
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


def _has_inertia(node: NodeSpec) -> bool:
    return node.is_quadcopter or _has_autopilot(node)


def _has_autopilot(node: NodeSpec) -> bool:
    return node.autopilot is not None


def _has_wind(scenario: Scenario) -> bool:
    is_windy = any(scenario.wind.get(field, 0.0) for field in ("speed_mps", "gusts_mps"))
    return is_windy and any(map(_has_inertia, scenario.nodes))


def _has_position_errors(scenario: Scenario) -> bool:
    errors = (node.mobility.get("position_error_m") for node in scenario.nodes)
    return any(error and error.value for error in errors)


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
        has_node: Whether a node has the effect. Then the settings hold for such nodes alone, and a scenario
            has the effect if a node has it. None: the settings hold for all nodes.
    """

    name: str
    adds: str
    off: Mapping[str, str] = field(default_factory=dict)
    applies: Callable[[Scenario], bool] = _always
    is_added: bool = False
    has_node: Callable[[NodeSpec], bool] | None = None

    def of(self, scenario: Scenario) -> "Level | None":
        """Return the level with its settings for a scenario; None if that does not have the effect."""
        if self.has_node is None:
            return self if self.applies(scenario) else None
        names = _names(scenario.nodes, self.has_node)
        off = {key.replace("*.*", f"*.{name}", 1): value for name in names for key, value in self.off.items()}
        return replace(self, off=off) if names else None


def _names(nodes: Sequence[NodeSpec], has_effect: Callable[[NodeSpec], bool]) -> list[str]:
    """Return the names of those nodes as keys have them: a group once if all of it is meant."""
    names: list[str] = []
    for group, members in groupby(nodes, lambda node: node.group):
        of_group = list(members)
        chosen = [node.name for node in of_group if has_effect(node)]
        is_all = len(chosen) == len(of_group) and chosen[0] != group
        names += [f"{group}[*]"] if is_all else chosen
    return names


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
        "inertia",
        "vehicles that have to speed up and brake",
        {"*.*.mobility.typename": '"MasslessMobility"'},
        has_node=_has_inertia,
    ),
    Level(
        "autopilot",
        "vehicles flown by ArduPilot",
        {"*.*.mobility.typename": '"QuadcopterMobility"'},
        has_node=_has_autopilot,
    ),
    Level(
        "wind",
        "wind and gusts",
        {"*.wind.speed": "0mps", "*.wind.gusts": "0mps"},
        _has_wind,
    ),
    Level(
        "position",
        "errors of the positions that nodes know",
        {"*.*.mobility.positionError": "0m"},
        _has_position_errors,
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
        *(of_scenario for level in LEVELS if (of_scenario := level.of(scenario)) is not None),
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
