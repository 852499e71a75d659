"""What is allowed in a scenario and yet seldom meant: told before a run, which goes on all the same."""

import math
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import TYPE_CHECKING

from gradysim.config.keys.interface import IEEE802154
from gradysim.config.node_spec import NodeSpec
from gradysim.config.scenario import Scenario
from gradysim.config.setting import Setting
from gradysim.config.source import Source
from gradysim.config.unread_lines import Chosen, UnreadLines
from gradysim.integrated.network import medium_config, node_config
from gradysim.integrated.two_ray_ground import ground_hint

if TYPE_CHECKING:
    from gradysim._netsim import InterfaceConfig, MediumConfig, RadioConfig

_WITHOUT_RADIOS = "UnitDiskRadioMedium"
_OF_NO_USE_M = 100e3  # farther than any node flies to


def scenario_warnings(scenario: Scenario) -> list[str]:
    """Return one line of text for each: "FILE:LINE: warning: ..."."""
    medium = medium_config(scenario)
    return [
        *_unread_lines(scenario, medium),
        *_nodes_on_the_ground(scenario, medium),
        *_stations_without_a_common_mode(scenario, medium),
        *_nodes_that_nobody_hears(scenario, medium),
        *_obstacles_far_from_all_nodes(scenario),
        *_acks_that_come_too_late(scenario, medium),
    ]


def _unread_lines(scenario: Scenario, medium: "MediumConfig") -> Iterator[str]:
    """The parameters of models that were not chosen."""
    lines = UnreadLines()
    of_network = _sources("medium", scenario.medium)
    chosen = _chosen({"medium": medium}, of_network)
    lines.add(of_network, chosen)
    for obstacle in scenario.obstacles:
        lines.add(obstacle.sources, chosen)
    for spec in _one_of_each_kind(scenario.nodes):
        config = node_config(spec)
        name = f"{spec.group}[*]" if spec.name.endswith("]") else spec.name
        sources = {f"protocol.{field}": source for field, source in spec.protocol_sources.items()}
        sources |= _sources("mobility", spec.mobility)
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
    return lines.texts()


def _by_kind(nodes: Iterable[NodeSpec]) -> Mapping[object, Sequence[NodeSpec]]:
    """Nodes with the same lines in force share their mappings."""
    kinds: dict[object, list[NodeSpec]] = {}
    for spec in nodes:
        kind = (spec.group, id(spec.protocol_sources), id(spec.mobility), *map(id, spec.wlan))
        kinds.setdefault(kind, []).append(spec)
    return kinds


def _one_of_each_kind(nodes: Iterable[NodeSpec]) -> Iterable[NodeSpec]:
    return [specs[0] for specs in _by_kind(nodes).values()]


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


def _stations_without_a_common_mode(scenario: Scenario, medium: "MediumConfig") -> Iterator[str]:
    """Pairs of operation modes on one channel of which neither knows a format of the other."""
    if medium.typename == _WITHOUT_RADIOS:
        return
    stations: dict[tuple[float, str], tuple[NodeSpec, InterfaceConfig, Source | None]] = {}
    for spec in _one_of_each_kind(scenario.nodes):
        for interface, wlan in zip(node_config(spec).wlan, spec.wlan, strict=True):
            setting = wlan.mac.get("op_mode")
            station = (spec, interface, setting.source if setting else None)
            stations.setdefault((interface.radio.carrier_hz, interface.mac.op_mode), station)
    for ((carrier_hz, mode), one), ((other_hz, other_mode), other) in combinations(stations.items(), 2):
        if carrier_hz == other_hz and not one[1].known_formats & other[1].known_formats:
            yield (
                f"{other[2] or one[2]}: warning: {one[0].name} and {other[0].name} are on one channel, but of"
                f' operation modes "{mode}" and "{other_mode}", which have no kind of frame in common:'
                " they are noise to each other; expected one mode for both, or"
                ' "g(mixed)", which has the frames of "b" and "g(erp)"'
            )


def _nodes_that_nobody_hears(scenario: Scenario, medium: "MediumConfig") -> Iterator[str]:
    """Nodes that share no channel with any other."""
    if medium.typename == _WITHOUT_RADIOS or len(scenario.nodes) < 2:
        return
    kinds = [
        (specs[0], [interface.radio for interface in node_config(specs[0]).wlan], len(specs))
        for specs in _by_kind(scenario.nodes).values()
    ]
    for index, (spec, radios, count) in enumerate(kinds):
        others = [
            listener
            for other, (_, listeners, _) in enumerate(kinds)
            if other != index or count > 1
            for listener in listeners
        ]
        if not any(_fits_in(radio, listener) for radio in radios for listener in others):
            line = next(_sources_of_channels([spec, *scenario.nodes]))
            channels = " and ".join(f"{radio.carrier_hz / 1e6:g} MHz" for radio in radios)
            yield (
                f"{line}: warning: nobody hears {spec.name}: no other node listens at {channels} with at"
                " least as much bandwidth; expected one channel for those that are to talk"
            )


def _sources_of_channels(specs: Iterable[NodeSpec]) -> Iterator[Source]:
    for wlan in (wlan for spec in specs for wlan in spec.wlan):
        for settings, field in (
            (wlan.radio, "carrier_hz"),
            (wlan.radio, "bandwidth_hz"),
            (wlan.interface, "typename"),
        ):
            if field in settings:
                yield settings[field].source


def _fits_in(sender: "RadioConfig", listener: "RadioConfig") -> bool:
    return sender.carrier_hz == listener.carrier_hz and sender.bandwidth_hz <= listener.bandwidth_hz


def _obstacles_far_from_all_nodes(scenario: Scenario) -> Iterator[str]:
    """A scene that is somewhere else, as when longitude and latitude are exchanged."""
    corners = [corner for obstacle in scenario.obstacles for ring in obstacle.rings for corner in ring]
    if not corners or not scenario.nodes:
        return
    west, east = min(x for x, _ in corners), max(x for x, _ in corners)
    south, north = min(y for _, y in corners), max(y for _, y in corners)
    nearest_m = min(
        math.hypot(max(west - x, x - east, 0), max(south - y, y - north, 0))
        for x, y, _ in (spec.initial_position for spec in scenario.nodes)
    )
    if nearest_m > _OF_NO_USE_M:
        yield (
            f"{scenario.obstacles[0].source}: warning: all obstacles are {nearest_m / 1000:.0f} km and more"
            " from where any node starts; expected them around the nodes (a GeoJSON file has longitude"
            " before latitude)"
        )


def _acks_that_come_too_late(scenario: Scenario, medium: "MediumConfig") -> Iterator[str]:
    """Devices of 802.15.4 that have given up before an ACK can have ended."""
    if medium.typename == _WITHOUT_RADIOS:
        return
    told = set()
    for spec in _one_of_each_kind(scenario.nodes):
        for interface, wlan in zip(node_config(spec).wlan, spec.wlan, strict=True):
            csma = interface.csma
            setting = wlan.csma.get("ack_wait_s", wlan.csma.get("sifs_s"))
            is_read = interface.typename == IEEE802154.names[0] and csma.use_acks
            if not is_read or setting is None or csma.ack_wait_s > csma.ack_end_s or setting.source in told:
                continue
            told.add(setting.source)
            ack_us = (csma.ack_end_s - csma.sifs_s) * 1e6
            yield (
                f"{setting.source}: warning: who waits {csma.ack_wait_s * 1e6:.6g}us for an ACK, which ends"
                f" {csma.ack_end_s * 1e6:.6g}us after the frame (a sifs, and {ack_us:.6g}us on the air),"
                " repeats frames that have arrived; expected a longer macAckWaitDuration, or"
                " `useMACAcks = false`"
            )
