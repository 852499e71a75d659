"""The network interfaces of nodes: their numbers and their settings.

Interfaces with the same entries in force share one InterfaceSpec, also those of one node.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from gradysim.scenario.errors import ConfigError, ErrorCollector
from gradysim.scenario.node_spec import STRUCTS, InterfaceSpec
from gradysim.scenario.resolve.lines import Row, read_struct
from gradysim.scenario.resolve.resolution import NodeKind, Resolution
from gradysim.scenario.schema.engine_keys import Key
from gradysim.scenario.schema.keys import (
    BAND_BESIDE_FREQUENCY,
    BAND_NAME,
    BAND_OF_CHANNEL,
    CENTER_FREQUENCY,
    CHANNEL_NUMBER,
    IEEE802154,
    INTERFACE_TYPENAME,
    OF_802154,
    WLAN_KEYS,
    at_interface,
    index_of_interface,
)
from gradysim.scenario.schema.parameter_types import BAND, CHANNELS
from gradysim.scenario.schema.values import SettingReader

Rows = Mapping[Key, Row]
"""Of one interface."""

_KEYS = frozenset(WLAN_KEYS)


class InterfaceBuilder:
    """Makes the interfaces of nodes."""

    def __init__(self, resolution: Resolution, settings: SettingReader, errors: ErrorCollector) -> None:
        """Read values with `settings`; `errors` takes the errors."""
        self._settings = settings
        self._errors = errors
        self._known: dict[object, InterfaceSpec] = {}
        self._of_kind: dict[NodeKind, tuple[InterfaceSpec, ...]] = {}
        self._resolution = resolution

    def interfaces(self, node: str, kind: NodeKind) -> tuple[InterfaceSpec, ...]:
        """Return the interfaces of a node."""
        if kind.differing.isdisjoint(STRUCTS):
            known = self._of_kind.get(kind)
            if known is None:
                known = self._of_kind[kind] = self._interfaces(node, kind)
            return known
        return self._interfaces(node, kind)

    def _interfaces(self, node: str, kind: NodeKind) -> tuple[InterfaceSpec, ...]:
        rows: list[list[Row]] = [[] for _ in range(kind.interface_count)]
        for row in kind.rows.values():
            if row.key in _KEYS:
                rows[index_of_interface(row.path)].append(row)
        return tuple(self._interface(node, index, of_one) for index, of_one in enumerate(rows))

    def _interface(self, node: str, index: int, rows: list[Row]) -> InterfaceSpec:
        own = (node, index) if any(row.line.differs for row in rows) else None
        known = (own, *((row.key, row.line) for row in rows))
        spec = self._known.get(known)
        if spec is None:
            spec = self._known[known] = self._made(node, index, {row.key: row for row in rows})
        return spec

    def _made(self, node: str, index: int, by_key: Rows) -> InterfaceSpec:
        prefix = f"{node}."
        try:
            is_802154 = self._is_802154(by_key)
            rows = _of_802154(by_key) if is_802154 else self._in_its_band(by_key, prefix)
        except ConfigError as error:  # the numbers of channels have no meaning then
            self._errors.add(error)
            is_802154, rows = False, _without(by_key, CHANNEL_NUMBER)
        errors = ErrorCollector()
        structs = {struct: read_struct(struct, rows, self._settings, errors, prefix) for struct in STRUCTS}
        channel = by_key.get(CHANNEL_NUMBER)
        for of_field in errors.errors:
            is_of_channel = channel is not None and channel.line.entry.source == of_field.source
            if is_of_channel and self._has_typenames():
                of_field = self._of_one_kind_only(of_field, node, index, is_802154)
            self._errors.add(of_field)
        return InterfaceSpec(**structs, range_sets_power=_range_comes_first(by_key.values()))

    def _has_typenames(self) -> bool:
        """Return whether there may be interfaces of both kinds."""
        return any(row.key == INTERFACE_TYPENAME for row in self._resolution.rows())

    def _is_802154(self, by_key: Rows) -> bool:
        chosen = by_key.get(INTERFACE_TYPENAME)
        if chosen is None or chosen.line.is_default:
            return False
        return self._settings.scalar(chosen.line.entry, INTERFACE_TYPENAME.kind) in IEEE802154.names

    def _in_its_band(self, by_key: Rows, prefix: str) -> Sequence[Row]:
        """Read the number of a channel as one of the band that is set with it.

        A band has no further effect if a channel or its center is set.
        """
        written = {key: row for key, row in by_key.items() if not row.line.is_default}
        band = written.get(BAND_NAME)
        channel, center = written.get(CHANNEL_NUMBER), written.get(CENTER_FREQUENCY)
        if band is None or (channel is None and center is None):
            return list(by_key.values())
        name = str(self._settings.scalar(band.line.entry, BAND, prefix + band.path))
        rows = _without(by_key, BAND_NAME, CHANNEL_NUMBER)
        if channel is not None:
            rows.append(channel._replace(key=replace(CHANNEL_NUMBER, kind=CHANNELS[name])))
        if center is None or (channel is not None and channel.line.order < center.line.order):
            rows.append(band._replace(key=BAND_OF_CHANNEL))
        elif not center.line.overrides(band.line):
            rows.append(band._replace(key=BAND_BESIDE_FREQUENCY))
        return rows

    def _of_one_kind_only(self, error: ConfigError, node: str, index: int, is_802154: bool) -> ConfigError:
        """Add a hint to an error of a channel: the standards number them differently, `**` matches both."""
        if _is_about_this_alone(error.key, node, index, self._resolution.kinds[node].interface_count):
            return error
        kind, other = ("802.15.4", "802.11") if is_802154 else ("802.11", "802.15.4")
        group, bracket, _ = node.partition("[")
        line = f"*.{group}{bracket and '[*]'}.{at_interface(CHANNEL_NUMBER.path, index)} = default"
        hint = (
            f", since wlan[{index}] of {node} is of {kind}; the line `{line}` before it leaves it to {other}"
        )
        return error.with_hint(hint)


def _without(by_key: Rows, *keys: Key) -> list[Row]:
    return [row for key, row in by_key.items() if key not in keys]


def _of_802154(by_key: Rows) -> Sequence[Row]:
    """Read the number of a channel as one of 802.15.4, which has one band."""
    return [row._replace(key=OF_802154.get(key, key)) for key, row in by_key.items()]


def _is_about_this_alone(key: str, node: str, index: int, count: int) -> bool:
    """Return whether a key names a node's group and, of several interfaces, this one."""
    group = node.partition("[")[0]
    return key.startswith((f"*.{group}.", f"*.{group}[")) and (count == 1 or f".wlan[{index}]." in key)


def _range_comes_first(rows: Iterable[Row]) -> bool:
    """Return whether a range is set, and not after a power."""
    orders = {row.key.field: row.line.order for row in rows if not row.line.is_default}
    at = orders.get("communication_range_m")
    return at is not None and at <= orders.get("tx_power_w", at)
