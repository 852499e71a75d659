"""Radios that are set up so that they cannot talk to each other: told before a run."""

from collections.abc import Iterable, Iterator
from itertools import combinations
from typing import TYPE_CHECKING

from gradysim.config.errors.source import Source
from gradysim.config.keys.interface import IEEE802154
from gradysim.config.keys.radio_media import has_radios
from gradysim.config.node.interface_spec import InterfaceSpec
from gradysim.config.node.node_spec import NodeSpec
from gradysim.config.scenario import Scenario
from gradysim.integrated.network import node_config
from gradysim.integrated.node_kinds import by_kind, one_of_each_kind

if TYPE_CHECKING:
    from gradysim._netsim import InterfaceConfig, MediumConfig, RadioConfig


def radio_warnings(scenario: Scenario, medium: "MediumConfig") -> Iterator[str]:
    """Yield one line of text for each: "FILE:LINE: warning: ..."."""
    if not has_radios(medium.typename):
        return
    yield from _stations_without_a_common_mode(scenario)
    yield from _radios_that_nobody_hears(scenario)
    yield from _acks_that_come_too_late(scenario)


def _stations_without_a_common_mode(scenario: Scenario) -> Iterator[str]:
    """Pairs of operation modes on one channel of which neither knows a format of the other."""
    stations: dict[tuple[float, str], tuple[NodeSpec, InterfaceConfig, Source | None]] = {}
    for spec in one_of_each_kind(scenario.nodes):
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


def _radios_that_nobody_hears(scenario: Scenario) -> Iterator[str]:
    """Nodes that share no channel with any other, and interfaces of which no other node has the channel."""
    if len(scenario.nodes) < 2:
        return
    kinds = [
        (specs[0], [interface.radio for interface in node_config(specs[0]).wlan], len(specs))
        for specs in by_kind(scenario.nodes).values()
    ]
    for index, (spec, radios, count) in enumerate(kinds):
        others = [
            listener
            for other, (_, listeners, _) in enumerate(kinds)
            if other != index or count > 1
            for listener in listeners
        ]
        unheard = [
            number
            for number, radio in enumerate(radios)
            if not any(_fits_in(radio, listener) for listener in others)
        ]
        whole_node = len(unheard) == len(radios)
        for numbers in [unheard] if whole_node else [[number] for number in unheard]:
            who = spec.name if whole_node else f"wlan[{numbers[0]}] of {spec.name}"
            channels = " and ".join(f"{radios[number].carrier_hz / 1e6:g} MHz" for number in numbers)
            nearest_first = [spec.wlan[number] for number in numbers]
            nearest_first += [wlan for node in (spec, *scenario.nodes) for wlan in node.wlan]
            yield (
                f"{next(_sources_of_channels(nearest_first))}: warning: nobody hears {who}: no other node"
                f" listens at {channels} with at least as much bandwidth; expected one channel for those"
                " that are to talk"
            )


def _sources_of_channels(wlans: Iterable[InterfaceSpec]) -> Iterator[Source]:
    for wlan in wlans:
        for settings, field in (
            (wlan.radio, "carrier_hz"),
            (wlan.radio, "bandwidth_hz"),
            (wlan.interface, "typename"),
        ):
            if field in settings:
                yield settings[field].source


def _fits_in(sender: "RadioConfig", listener: "RadioConfig") -> bool:
    return sender.carrier_hz == listener.carrier_hz and sender.bandwidth_hz <= listener.bandwidth_hz


def _acks_that_come_too_late(scenario: Scenario) -> Iterator[str]:
    """Devices of 802.15.4 that have given up before an ACK can have ended."""
    told = set()
    for spec in one_of_each_kind(scenario.nodes):
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
