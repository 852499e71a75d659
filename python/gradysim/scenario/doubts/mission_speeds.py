"""A mission of the plugin flies at a speed of its own, whatever `mobility.speed` says.

Nobody can mean both a speed in the .ini file and the default of a mission that says none. That it says none
is found in the text of the protocol's classes, before anything runs; where that sets some speed, however it
does, nothing is told.
"""

import ast
from collections.abc import Iterable, Iterator

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.mobility import SetSpeedMobilityCommand
from gradysim.protocol.plugin.mission_mobility import MissionMobilityConfiguration, MissionMobilityPlugin
from gradysim.scenario.doubts.protocol_code import called_name, code_of
from gradysim.scenario.errors import Source
from gradysim.scenario.node.node_spec import NodeSpec
from gradysim.scenario.protocol.kept_with_class import kept_with_class

_PLUGIN, _CONFIGURATION = MissionMobilityPlugin.__name__, MissionMobilityConfiguration.__name__
_COMMAND = SetSpeedMobilityCommand.__name__
_CONFIGURATION_PLACE = 1  # among the arguments of the plugin
_SPEED_PLACE = 0  # among those of the configuration


def mission_speeds(nodes: Iterable[NodeSpec]) -> Iterator[str]:
    """Yield one line of text for each `mobility.speed` that missions override, "FILE:LINE: warning: ..."."""
    told: set[Source] = set()
    default = MissionMobilityConfiguration().speed
    for spec in nodes:
        speed = spec.mobility.get("speed_mps")
        if speed is None or speed.source in told or speed.value == default:
            continue
        if _flies_at_the_default(spec.protocol):
            told.add(speed.source)
            yield (
                f"{speed.source}: warning: missions of {spec.protocol.__name__} do not fly at this speed,"
                f" but at {default:g} m/s, the default of {_CONFIGURATION};"
                f" expected `{_CONFIGURATION}(speed=...)` there"
            )


@kept_with_class
def _flies_at_the_default(protocol: type[IProtocol]) -> bool:
    """Whether it makes a mission plugin, neither configuration says a speed, and nothing sets one later."""
    code = code_of(protocol)
    if any(_sets_a_speed(node) for node in code):
        return False
    calls = [node for node in code if isinstance(node, ast.Call)]
    plugins = [call for call in calls if called_name(call) == _PLUGIN]
    configurations = [call for call in calls if called_name(call) == _CONFIGURATION]
    if any(_has(call, "speed", _SPEED_PLACE) for call in configurations):
        return False
    return any(configurations or not _has(call, "configuration", _CONFIGURATION_PLACE) for call in plugins)


def _sets_a_speed(node: ast.AST) -> bool:
    """As `configuration.speed = 9`, `replace(configuration, speed=9)` or a command to the vehicle do."""
    match node:
        case ast.Attribute(attr="speed", ctx=ast.Store()) | ast.keyword(arg="speed"):
            return True
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name == _COMMAND
    return False


def _has(call: ast.Call, name: str, place: int) -> bool:
    """Whether the call has that argument, or may have it in a `*` or `**`."""
    stars = any(isinstance(argument, ast.Starred) for argument in call.args)
    return stars or len(call.args) > place or any(keyword.arg in (name, None) for keyword in call.keywords)
