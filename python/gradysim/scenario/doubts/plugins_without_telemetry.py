"""`telemetryInterval = 0s` for nodes that fly missions and random trips, which go on by telemetry.

The line is right for nodes that stand. One that a plugin flies gets to its first waypoint, is not told, and
stays there. Whether a plugin flies it is found in the text of the protocol's classes, before anything runs;
where the protocol itself sets one waypoint after the other, nothing is told.
"""

import ast
from collections.abc import Iterable, Iterator

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin
from gradysim.protocol.plugin.random_mobility import RandomMobilityPlugin
from gradysim.scenario.doubts.protocol_code import called_name, code_of
from gradysim.scenario.errors import Source
from gradysim.scenario.keys.mobility import STATIONARY
from gradysim.scenario.node.node_spec import NodeSpec
from gradysim.scenario.protocol.kept_with_class import kept_with_class

_MISSION, _TRIP = MissionMobilityPlugin.__name__, RandomMobilityPlugin.__name__
_WITHOUT_TELEMETRY = MissionMobilityPlugin.set_current_waypoint.__name__
_WITH_TELEMETRY = RandomMobilityPlugin.initiate_random_trip.__name__


def plugins_without_telemetry(nodes: Iterable[NodeSpec]) -> Iterator[str]:
    """Yield one line of text for each group of nodes that a line stops, "FILE:LINE: warning: ..."."""
    told: set[tuple[Source, type[IProtocol], str]] = set()
    for spec in nodes:
        interval = spec.mobility.get("telemetry_interval_s")
        if interval is None or interval.value != 0 or _stands(spec):
            continue
        stopped = (interval.source, spec.protocol, spec.group)
        if stopped in told:
            continue
        told.add(stopped)
        for plugin in _that_need_telemetry(spec.protocol):
            yield (
                f"{interval.source}: warning: {spec.group} will not get beyond the first waypoint, as the"
                f" {plugin} of {spec.protocol.__name__} goes on by telemetry, and 0s is none; expected an"
                " interval such as 10ms"
            )


def _stands(spec: NodeSpec) -> bool:
    typename = spec.mobility.get("typename")
    return typename is not None and typename.value == STATIONARY


@kept_with_class
def _that_need_telemetry(protocol: type[IProtocol]) -> tuple[str, ...]:
    code = code_of(protocol)
    names = {node.attr for node in code if isinstance(node, ast.Attribute)}
    made = {called_name(node) for node in code if isinstance(node, ast.Call)}
    flies = {_MISSION: _WITHOUT_TELEMETRY not in names, _TRIP: _WITH_TELEMETRY in names}
    return tuple(plugin for plugin, does in flies.items() if does and plugin in made)
