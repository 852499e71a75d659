"""Each run of a command begins with protocols that no run before it has touched."""

from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gradysim.scenario.scenario import Scenario


def with_fresh_protocols(scenario: "Scenario") -> "Scenario":
    """Return the scenario with the files of its protocols loaded anew, as they were when it was read.

    What runs before it have left in the bodies of classes, or in modules beside them, makes no difference
    then: a run is the same as in a process of its own.
    """
    from gradysim.scenario.protocol_modules import ModuleLoader, origin_of

    loader = ModuleLoader()
    anew = {
        cls: replace(origin, loader=loader).load()
        for cls in {node.protocol for node in scenario.nodes}
        if (origin := origin_of(cls)) is not None
    }
    if not anew:
        return scenario
    nodes = (replace(node, protocol=anew.get(node.protocol, node.protocol)) for node in scenario.nodes)
    return replace(scenario, nodes=tuple(nodes))
