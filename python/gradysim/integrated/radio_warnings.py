"""Radios that are set up so that they cannot talk to each other: told before a run."""

from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import chain, takewhile
from typing import TYPE_CHECKING, NamedTuple

from gradysim.integrated.network import node_config
from gradysim.integrated.node_kinds import by_kind, one_of_each_kind
from gradysim.scenario.errors import Source
from gradysim.scenario.keys.interface import IEEE802154
from gradysim.scenario.keys.radio_media import has_radios
from gradysim.scenario.node.interface_spec import InterfaceSpec
from gradysim.scenario.node.node_spec import NodeSpec
from gradysim.scenario.scenario import Scenario

if TYPE_CHECKING:
    from gradysim._netsim import InterfaceConfig, MediumConfig, RadioConfig


class _Band(NamedTuple):
    """What a radio sends and listens in."""

    carrier_hz: float
    bandwidth_hz: float

    @classmethod
    def of(cls, radio: "RadioConfig") -> "_Band":
        return cls(radio.carrier_hz, radio.bandwidth_hz)

    def fits_in(self, listener: "_Band") -> bool:
        """The engine's `Band::fits_in`, which is not among its bindings."""
        return self.carrier_hz == listener.carrier_hz and self.bandwidth_hz <= listener.bandwidth_hz


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
    modes: dict[float, list[str]] = {}  # of each channel those that are still to be compared
    for carrier_hz, mode in stations:
        modes.setdefault(carrier_hz, []).append(mode)
    for (carrier_hz, mode), one in stations.items():
        modes[carrier_hz].remove(mode)
        for other_mode in modes[carrier_hz]:
            other = stations[carrier_hz, other_mode]
            if not one[1].known_formats & other[1].known_formats:
                yield (
                    f"{other[2] or one[2]}: warning: {one[0].name} and {other[0].name} are on one channel,"
                    f' but of operation modes "{mode}" and "{other_mode}", which have no kind of frame in'
                    " common: they are noise to each other; expected one mode for both, or"
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
    listeners: Counter[_Band] = Counter()
    for _, radios, count in kinds:
        for band in set(map(_Band.of, radios)):
            listeners[band] += count
    widest_first: dict[float, list[_Band]] = {}
    for band in sorted(listeners, key=lambda band: -band.bandwidth_hz):
        widest_first.setdefault(band.carrier_hz, []).append(band)
    for spec, radios, _ in kinds:
        own = list(map(_Band.of, radios))
        unheard = [
            number
            for number, sent in enumerate(own)
            if not any(
                listeners[band] > (band in own)  # some other node
                for band in takewhile(sent.fits_in, widest_first[sent.carrier_hz])
            )
        ]
        whole_node = len(unheard) == len(radios)
        for numbers in [unheard] if whole_node else [[number] for number in unheard]:
            who = spec.name if whole_node else f"wlan[{numbers[0]}] of {spec.name}"
            channels = " and ".join(f"{radios[number].carrier_hz / 1e6:g} MHz" for number in numbers)
            nearest_first = chain(
                (spec.wlan[number] for number in numbers),
                (wlan for node in chain((spec,), scenario.nodes) for wlan in node.wlan),
            )
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
