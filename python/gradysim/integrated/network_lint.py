"""Lint checks of integrated mode: settings that are valid but probably not intended."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

from gradysim.integrated.network import by_kind, medium_config, node_config, one_of_each_kind
from gradysim.integrated.two_ray_ground import ground_hint
from gradysim.scenario.errors import Source
from gradysim.scenario.lint import Finding, by_line
from gradysim.scenario.node_spec import InterfaceSpec, NodeSpec
from gradysim.scenario.parse.ini import PROFILES
from gradysim.scenario.resolve.models import Chosen, Models, unmet_choice
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.engine_keys import ReadBy
from gradysim.scenario.schema.keys import (
    IEEE802154,
    KEYS_BY_TARGET,
    NETWORK_KEYS,
    has_radios,
    written_for,
)
from gradysim.scenario.schema.values import SettingReader

if TYPE_CHECKING:
    from gradysim._netsim import InterfaceConfig, MediumConfig, RadioConfig

_CHOOSERS_OF_THE_NETWORK = frozenset(key.target for key in NETWORK_KEYS)

_MOST_LINES = 4
"""Largest number of lines that a message lists in addition to its own."""

_FARTHEST_FLIGHT_M = 100e3
"""Obstacles farther from all nodes than this have no use."""


def lint_networks(scenarios: Iterable[Scenario]) -> list[Finding]:
    """Check the networks of the runs of a configuration, in addition to `scenario.lint.lint`."""
    unread = UnreadLines()
    findings: list[Finding] = []
    different = {(id(scenario.nodes), id(scenario.medium)): scenario for scenario in scenarios}
    for scenario in different.values():
        medium = medium_config(scenario)
        _add_lines(unread, scenario)
        findings += _ground(scenario, medium)
        findings += _obstacles_far_from_all_nodes(scenario)
        if has_radios(medium.typename):
            findings += _stations_without_a_common_mode(scenario)
            findings += _radios_that_no_node_receives(scenario)
            findings += _acks_that_come_too_late(scenario)
    return by_line([*unread.findings(), *findings])


# Unread lines: parameters of a model that was not chosen. A line counts as read if one node, or the network,
# reads it in one run of a study, since a line with wildcards is meant for the nodes that have the model.


@dataclass
class _Unread:
    """Why a line is not read: what must be chosen, for which nodes, and what is chosen there."""

    choice: ReadBy
    prefix: str
    chosen: set[str] = field(default_factory=set)


class UnreadLines:
    """Collects which lines are read, over all nodes and runs that they are in force for."""

    def __init__(self) -> None:
        self._read: set[Source] = set()
        self._unread: dict[Source, _Unread] = {}

    def add(self, target: str, source: Source, chosen: Chosen, node: str = "") -> None:
        """Add a line in force for one node, or for the network, by the target of its key.

        `node` is the node, or its group, as .ini files write it: "uavs[*]".
        """
        choice = unmet_choice(target, chosen)
        if choice is None or source.file.parent == PROFILES:  # a profile is meant to be overridden
            self._read.add(source)
            return
        prefix = "*." if choice.chosen_by in _CHOOSERS_OF_THE_NETWORK else f"*.{node}."
        unread = self._unread.setdefault(source, _Unread(choice, prefix))
        if unread.choice == choice:
            unread.chosen.add(chosen(choice.chosen_by) or "")

    def findings(self) -> Iterator[Finding]:
        """Yield one finding for all lines that lack the same choice, at the first of them."""
        alike: dict[tuple[str, ReadBy, frozenset[str]], list[Source]] = {}
        unread_sources = self._unread.keys() - self._read
        for source in sorted(unread_sources, key=lambda source: (source.file, source.line, source.key)):
            unread = self._unread[source]
            key = unread.prefix + written_for(KEYS_BY_TARGET[unread.choice.chosen_by].written, source.key)
            alike.setdefault((key, unread.choice, frozenset(unread.chosen)), []).append(source)
        for (key, choice, chosen), (first, *others) in alike.items():
            yield Finding(
                first,
                f"nothing reads `{first.key}`{_other_lines(first, others)}: that takes"
                f" `{key} = {_quoted(choice.names)}`, and it is {_quoted(sorted(chosen))}",
            )


def _other_lines(first: Source, others: list[Source]) -> str:
    if not others:
        return ""
    if len(others) > _MOST_LINES:
        return f", nor {len(others)} other lines"
    lines = [str(other.line) if other.line and other.file == first.file else str(other) for other in others]
    return f", nor {'line' if len(lines) == 1 else 'lines'} {_joined(lines, 'and')}"


def _quoted(names: Iterable[str]) -> str:
    return _joined([f'"{name}"' for name in names], "or")


def _joined(texts: list[str], word: str) -> str:
    return f" {word} ".join([*([", ".join(texts[:-1])] if texts[1:] else []), texts[-1]])


def _add_lines(lines: UnreadLines, scenario: Scenario) -> None:
    """Add the lines of one run."""
    assert scenario.resolution is not None
    for row, target, node, chosen in Models(scenario.resolution, SettingReader(scenario.seed)).rows():
        if not row.line.is_default:
            group, bracket, _ = node.partition("[")
            lines.add(target, row.line.entry.source, chosen, f"{group}[*]" if bracket else node)


def _ground(scenario: Scenario, medium: "MediumConfig") -> Iterator[Finding]:
    path_loss = scenario.medium.get("path_loss")
    if path_loss is None or not has_radios(medium.typename):
        return
    if hint := ground_hint(medium, scenario.nodes):
        yield Finding(path_loss.source, hint)
    if medium.path_loss == "TwoRayInterference" and "epsilon_r" not in scenario.medium:
        key = KEYS_BY_TARGET["medium.epsilon_r"].written
        yield Finding(
            path_loss.source,
            f"a ground with the default permittivity of {medium.epsilon_r:g} hardly reflects; expected"
            f" `*.{key} =` 3 for dry soil, 15 for moist soil, or 81 for the sea",
        )


def _obstacles_far_from_all_nodes(scenario: Scenario) -> Iterator[Finding]:
    """Yield a finding if the scene is far from the nodes.

    For example, with longitude and latitude exchanged.
    """
    corners = [corner for obstacle in scenario.obstacles for ring in obstacle.rings for corner in ring]
    if not corners or not scenario.nodes:
        return
    south, north = min(x for x, _ in corners), max(x for x, _ in corners)
    west, east = min(y for _, y in corners), max(y for _, y in corners)
    nearest_m = min(
        math.hypot(max(south - x, x - north, 0), max(west - y, y - east, 0))
        for x, y, _ in (spec.initial_position for spec in scenario.nodes)
    )
    if nearest_m > _FARTHEST_FLIGHT_M:
        yield Finding(
            scenario.obstacles[0].source,
            f"all obstacles are {nearest_m / 1000:.0f} km or more from the start of any node; expected them"
            " around the nodes (a GeoJSON file has longitude before latitude)",
        )


class _Band(NamedTuple):
    """Frequency band of a radio."""

    carrier_hz: float
    bandwidth_hz: float

    @classmethod
    def of(cls, radio: "RadioConfig") -> "_Band":
        return cls(radio.carrier_hz, radio.bandwidth_hz)

    def fits_in(self, listener: "_Band") -> bool:
        """As the engine's `Band::fits_in`, which has no binding."""
        return self.carrier_hz == listener.carrier_hz and self.bandwidth_hz <= listener.bandwidth_hz


def _stations_without_a_common_mode(scenario: Scenario) -> Iterator[Finding]:
    """Yield pairs of operation modes on one channel that have no frame format in common."""
    stations: dict[float, dict[str, tuple[NodeSpec, InterfaceConfig, Source | None]]] = {}
    for spec in one_of_each_kind(scenario.nodes):
        for interface, wlan in zip(node_config(spec).wlan, spec.wlan, strict=True):
            setting = wlan.mac.get("op_mode")
            station = (spec, interface, setting.source if setting else None)
            stations.setdefault(interface.radio.carrier_hz, {}).setdefault(interface.mac.op_mode, station)
    for by_mode in stations.values():
        modes = list(by_mode)
        for number, mode in enumerate(modes):
            for other_mode in modes[number + 1 :]:
                spec, interface, source = by_mode[mode]
                other_spec, other_interface, other_source = by_mode[other_mode]
                reported = other_source or source
                if reported is not None and not interface.known_formats & other_interface.known_formats:
                    yield Finding(
                        reported,
                        f'{spec.name} and {other_spec.name} are on one channel with operation modes "{mode}"'
                        f' and "{other_mode}", which have no frame format in common: they are noise to each'
                        ' other; expected one mode for both, or "g(mixed)", which has the frames of "b" and'
                        ' "g(erp)"',
                    )


def _radios_that_no_node_receives(scenario: Scenario) -> Iterator[Finding]:
    """Yield nodes that share no channel with another node, and interfaces whose channel no other node has."""
    if len(scenario.nodes) < 2:
        return
    kinds = [
        (specs[0], [_Band.of(interface.radio) for interface in node_config(specs[0]).wlan], len(specs))
        for specs in by_kind(scenario.nodes).values()
    ]
    listeners: Counter[_Band] = Counter()
    for _, bands, count in kinds:
        for band in set(bands):
            listeners[band] += count
    on_carrier: dict[float, list[_Band]] = {}
    for band in listeners:
        on_carrier.setdefault(band.carrier_hz, []).append(band)
    for spec, bands, _ in kinds:
        unheard = [
            number
            for number, sent in enumerate(bands)
            if not any(
                sent.fits_in(band) and listeners[band] > (band in bands)  # some other node
                for band in on_carrier[sent.carrier_hz]
            )
        ]
        is_whole_node = len(unheard) == len(bands)
        for numbers in [unheard] if is_whole_node else [[number] for number in unheard]:
            name = spec.name if is_whole_node else f"wlan[{numbers[0]}] of {spec.name}"
            channels = " and ".join(f"{bands[number].carrier_hz / 1e6:g} MHz" for number in numbers)
            nearest_first = chain(
                (spec.wlan[number] for number in numbers),
                (wlan for node in chain((spec,), scenario.nodes) for wlan in node.wlan),
            )
            yield Finding(
                next(_sources_of_channels(nearest_first)),
                f"no node can receive {name}: no other node listens at {channels} with at least as much"
                " bandwidth; expected one channel for nodes that talk to each other",
            )


def _sources_of_channels(wlans: Iterable[InterfaceSpec]) -> Iterator[Source]:
    for wlan in wlans:
        for settings, name in (
            (wlan.radio, "carrier_hz"),
            (wlan.radio, "bandwidth_hz"),
            (wlan.interface, "typename"),
        ):
            if name in settings:
                yield settings[name].source


def _acks_that_come_too_late(scenario: Scenario) -> Iterator[Finding]:
    """Yield settings of 802.15.4 with which a sender gives up before an ACK can end."""
    found: set[Source] = set()
    for spec in one_of_each_kind(scenario.nodes):
        for interface, wlan in zip(node_config(spec).wlan, spec.wlan, strict=True):
            csma = interface.csma
            setting = wlan.csma.get("ack_wait_s", wlan.csma.get("sifs_s"))
            is_read = interface.typename == IEEE802154.names[0] and csma.use_acks
            if not is_read or setting is None or csma.ack_wait_s > csma.ack_end_s or setting.source in found:
                continue
            found.add(setting.source)
            ack_us = (csma.ack_end_s - csma.sifs_s) * 1e6
            yield Finding(
                setting.source,
                f"a sender waits {csma.ack_wait_s * 1e6:.6g}us for an ACK, which ends"
                f" {csma.ack_end_s * 1e6:.6g}us after the frame (a SIFS, then {ack_us:.6g}us on the air), and"
                " repeats frames that have arrived; expected a longer macAckWaitDuration, or"
                " `useMACAcks = false`",
            )
