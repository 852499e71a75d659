"""What is allowed in a scenario and yet seldom meant: told before a run, which goes on all the same."""

import math
from collections.abc import Container, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from gradysim.integrated.network import medium_config, node_config
from gradysim.integrated.node_kinds import one_of_each_kind
from gradysim.integrated.radio_warnings import radio_warnings
from gradysim.integrated.two_ray_ground import ground_hint
from gradysim.scenario.doubts.unread_lines import Chosen, UnreadLines
from gradysim.scenario.errors import Source
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.value.setting import Setting

if TYPE_CHECKING:
    from gradysim._netsim import MediumConfig

_OF_NO_USE_M = 100e3  # farther than any node flies to


def scenario_warnings(scenarios: Iterable[Scenario]) -> list[str]:
    """Return one line of text for each, once for all runs of a configuration: "FILE:LINE: warning: ..."."""
    unread = UnreadLines()
    others: list[str] = []
    for scenario in scenarios:
        medium = medium_config(scenario)
        _add_lines(unread, scenario, medium)
        others += _nodes_on_the_ground(scenario, medium)
        others += _obstacles_far_from_all_nodes(scenario)
        others += radio_warnings(scenario, medium)
    return [*unread.texts(), *dict.fromkeys(others)]


def _add_lines(lines: UnreadLines, scenario: Scenario, medium: "MediumConfig") -> None:
    """Those of one run: the parameters of models that no run has chosen are read by none."""
    of_network = _sources("medium", scenario.medium)
    chosen = _chosen({"medium": medium}, of_network)
    lines.add(of_network, chosen)
    for obstacle in scenario.obstacles:
        lines.add(obstacle.sources, chosen)
    for spec in one_of_each_kind(scenario.nodes):
        config = node_config(spec)
        name = f"{spec.group}[*]" if spec.name.endswith("]") else spec.name
        sources = {f"protocol.{field}": source for field, source in spec.protocol_sources.items()}
        sources |= _sources("mobility", spec.mobility) | _sources("autopilot", spec.idle_autopilot)
        of_node = {"medium": medium, "mobility": config.mobility}
        lines.add(sources, _chosen(of_node, {*of_network, *sources}), name)
        for interface, wlan in zip(config.wlan, spec.wlan, strict=True):
            sources = {}
            for struct, settings in wlan.structs().items():
                sources |= _sources(struct, settings)
            structs = {
                "medium": medium,
                "interface": interface,
                "radio": interface.radio,
                "antenna": interface.radio.antenna,
                "mac": interface.mac,
                "csma": interface.csma,
            }
            lines.add(sources, _chosen(structs, {*of_network, *sources}), name)


def _sources(struct: str, settings: Mapping[str, Setting]) -> dict[str, Source]:
    return {f"{struct}.{field}": setting.source for field, setting in settings.items()}


def _chosen(structs: Mapping[str, object], written: Container[str]) -> Chosen:
    def chosen(target: str) -> str | None:
        struct, _, field = target.partition(".")
        name = str(getattr(structs[struct], field))
        return None if not name and target in written else name

    return chosen


def _nodes_on_the_ground(scenario: Scenario, medium: "MediumConfig") -> Iterator[str]:
    """Nodes whose two rays cancel."""
    path_loss = scenario.medium.get("path_loss")
    hint = ground_hint(medium, scenario.nodes)
    if path_loss is not None and hint:
        yield f"{path_loss.source}: warning: {hint}"


def _obstacles_far_from_all_nodes(scenario: Scenario) -> Iterator[str]:
    """A scene that is somewhere else, as when longitude and latitude are exchanged."""
    corners = [corner for obstacle in scenario.obstacles for ring in obstacle.rings for corner in ring]
    if not corners or not scenario.nodes:
        return
    south, north = min(x for x, _ in corners), max(x for x, _ in corners)
    west, east = min(y for _, y in corners), max(y for _, y in corners)
    nearest_m = min(
        math.hypot(max(south - x, x - north, 0), max(west - y, y - east, 0))
        for x, y, _ in (spec.initial_position for spec in scenario.nodes)
    )
    if nearest_m > _OF_NO_USE_M:
        yield (
            f"{scenario.obstacles[0].source}: warning: all obstacles are {nearest_m / 1000:.0f} km and more"
            " from where any node starts; expected them around the nodes (a GeoJSON file has longitude"
            " before latitude)"
        )
