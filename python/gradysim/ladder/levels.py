"""The levels of the ladder. Each adds one effect to the level before, in physical order.

A level is declared by the settings that leave its effect out. At level k, the effects of the levels above k
are left out, and everything else is as the scenario says. Random streams have a purpose each, so that levels
share positions, traffic and all draws that both of them make.

Any effect can be left out alone. Some cannot exist without others: frames without airtime do not collide, and
a circle knows no noise. Such a level names what it needs, and is left out with it.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import Any

from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.parse.ini import Section
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.keys import MASSLESS, PATH_LOSS_EFFECTS, QUADCOPTER
from gradysim.scenario.schema.values import Setting

UNIT_DISK = "UnitDiskRadioMedium"
_UNLIMITED = "1e9m"


def _value(settings: Mapping[str, Setting], field: str, default: Any = None) -> Any:
    """Return the value of a field, or the default if the scenario does not set it."""
    chosen = settings.get(field)
    return default if chosen is None else chosen.value


def _timing_is(*timings: str) -> Callable[[Scenario], bool]:
    """Return whether one of these takes time, by `radioMedium.timing`."""
    return lambda scenario: _value(scenario.medium, "timing", _default_timing(scenario)) in timings


def _default_timing(scenario: Scenario) -> str:
    return "mac" if _has_radios(scenario) else "instant"


def _has_radios(scenario: Scenario) -> bool:
    return bool(_value(scenario.medium, "typename") != UNIT_DISK)


def _has_capture(scenario: Scenario) -> bool:
    return _has_radios(scenario) and _timing_is("mac")(scenario)


def _path_loss_has(effect: str) -> Callable[[Scenario], bool]:
    return lambda scenario: _value(scenario.medium, "path_loss") in PATH_LOSS_EFFECTS[effect]


def _has_shadowing(scenario: Scenario) -> bool:
    sigma_db = float(_value(scenario.medium, "shadowing_standard_deviation_db", 0))
    return _path_loss_has("shadowing")(scenario) or sigma_db > 0


def _has_other_systems(scenario: Scenario) -> bool:
    return _has_radios(scenario) and float(_value(scenario.medium, "other_systems_w", 0)) > 0


def _has_obstacles(scenario: Scenario) -> bool:
    return bool(scenario.obstacles and _value(scenario.medium, "obstacle_loss"))


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
    return any(_value(node.mobility, "position_error_m") for node in scenario.nodes)


def _has_command_delay(node: NodeSpec) -> bool:
    obeys = _value(node.mobility, "typename", MASSLESS) in (MASSLESS, QUADCOPTER)
    return bool(_value(node.mobility, "command_delay_s")) and obeys and not _has_autopilot(node)


def _takes_time(node: NodeSpec) -> bool:
    return node.processing_time_s > 0


def _has_drifting_clocks(scenario: Scenario) -> bool:
    return any(node.drift_rate for node in scenario.nodes)


@dataclass(frozen=True)
class Level:
    """One level.

    Attributes:
        name: Its name.
        adds: What it adds to the level before.
        off: {key: value} of the settings without its effect.
        needs: Names of the levels without which it has no effect.
        applies: Whether a scenario has the effect. Otherwise the level is left out.
        is_added: Whether it is a section `[Level NAME]` of the file, which adds lines to the scenario.
        has_node: Whether a node has the effect. Then the settings hold for such nodes alone, and a scenario
            has the effect if a node has it. None: the settings hold for all nodes.
    """

    name: str
    adds: str
    off: Mapping[str, str] = field(default_factory=dict)
    applies: Callable[[Scenario], bool] = lambda _: True
    needs: tuple[str, ...] = ()
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


_TIMING = "*.radioMedium.timing"
_ANY_POWER = "-300dBm"
_FREE_SPACE = {"*.radioMedium.pathLoss.typename": '"FreeSpacePathLoss"'}
_RADIO = "*.*.wlan[*].radio"

LEVELS = (
    Level("ideal", "nothing: messages arrive at once, everywhere"),
    Level(
        "range",
        "the range of the radio",
        {
            f"{_RADIO}.transmitter.communicationRange": _UNLIMITED,
            f"{_RADIO}.receiver.sensitivity": _ANY_POWER,
            f"{_RADIO}.receiver.preambleDetection.minimumPower": _ANY_POWER,
        },
    ),
    Level(
        "airtime",
        "time on the air and on the way",
        {_TIMING: '"instant"'},
        _timing_is("mac", "airtime", "aloha", "channelAccess"),
    ),
    Level(
        "access",
        "waiting until the channel is free",
        {_TIMING: '"airtime"'},
        _timing_is("mac", "channelAccess"),
        needs=("airtime",),
    ),
    Level(
        "radio",
        "reception by power instead of a circle",
        {"*.radioMedium.typename": f'"{UNIT_DISK}"'},
        _has_radios,
    ),
    Level(
        "interference",
        "the real MAC, and collisions: overlapping frames are lost",
        {_TIMING: '"channelAccess"'},
        _timing_is("mac", "aloha"),
        needs=("airtime",),
    ),
    Level(
        "capture",
        "survival of weaker interference",
        {
            f"{_RADIO}.receiver.collisionModel": '"overlap"',
            f"{_RADIO}.receiver.preambleDetection.typename": '""',
            f"{_RADIO}.receiver.frameCapture.typename": '""',
        },
        _has_capture,
        needs=("radio", "interference"),
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
        needs=("radio",),
    ),
    Level(
        "others",
        "noise of other systems, which changes with time",
        {"*.radioMedium.otherSystems.power": "0W"},
        _has_other_systems,
        needs=("radio", "noise"),
    ),
    Level(
        "shadowing",
        "a random gain of each link",
        {"*.radioMedium.pathLoss.sigma": "0", "*.radioMedium.shadowing.standardDeviation": "0dB"},
        _has_shadowing,
        needs=("radio",),
    ),
    Level(
        "fading",
        "gains that vary from frame to frame",
        _FREE_SPACE,
        _path_loss_has("fading"),
        needs=("radio",),
    ),
    Level(
        "ground",
        "reflection from the ground",
        _FREE_SPACE,
        _path_loss_has("ground"),
        needs=("radio",),
    ),
    Level(
        "obstacles",
        "obstacles that weaken or block frames",
        {"*.radioMedium.obstacleLoss.typename": '""'},
        _has_obstacles,
        needs=("radio",),
    ),
    Level(
        "antennas",
        "antennas that prefer directions",
        {f"{_RADIO}.antenna.typename": '"IsotropicAntenna"'},
        _has_antennas,
        needs=("radio",),
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
        needs=("inertia",),
        has_node=_has_autopilot,
    ),
    Level(
        "commands",
        "the time from a command until the vehicle obeys",
        {"*.*.mobility.commandDelay": "0s"},
        has_node=_has_command_delay,
    ),
    Level(
        "wind",
        "wind and gusts",
        {"*.wind.speed": "0mps", "*.wind.gusts": "0mps"},
        _has_wind,
        needs=("inertia",),
    ),
    Level(
        "position",
        "errors of the positions that nodes know",
        {"*.*.mobility.positionError": "0m"},
        _has_position_errors,
    ),
    Level(
        "computer",
        "the time that computers take for events of protocols",
        {"*.*.computer.processingTime": "0s"},
        has_node=_takes_time,
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


def working(effects: Collection[str], levels: Sequence[Level]) -> frozenset[str]:
    """Return those of these effects that have what they need."""
    present = {level.name for level in levels}
    found: set[str] = set()
    for level in levels:
        if level.name in effects and all(name in found for name in level.needs if name in present):
            found.add(level.name)
    return frozenset(found)


def settings_of(effects: Collection[str], levels: Sequence[Level]) -> list[str]:
    """Return the "KEY=VALUE" settings that leave out all other effects.

    The most ideal one comes first, since the first line of a key counts.
    """
    kept = working(effects, levels)
    left_out = [level for level in levels if level.name not in kept]
    off = [(key, value) for level in left_out for key, value in level.off.items()]
    if "interference" in kept:
        if "access" in kept:  # the MAC needs radios, and on a free-space path they make a circle
            off = [(key, value) for key, value in off if value != f'"{UNIT_DISK}"']
        else:
            off = [(key, '"aloha"' if key == _TIMING else value) for key, value in off]
    return [f"{key}={value}" for key, value in off]


def added_sections(effects: Collection[str], levels: Sequence[Level]) -> list[str]:
    """Return the names of the sections that these effects add."""
    return [level.name for level in levels if level.is_added and level.name in effects]


def _description(section: Section) -> str:
    written = next((entry.text for entry in section.entries if entry.key == "description"), "")
    return written.strip('"') or f"the lines of [Level {section.name}]"
