"""The network interfaces of nodes: their numbers and their settings.

Interfaces with the same entries in force share one InterfaceSpec, also those of one node.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace

from gradysim.scenario.errors import ConfigError, ErrorCollector
from gradysim.scenario.keys import (
    BAND_BESIDE_FREQUENCY,
    BAND_NAME,
    BAND_OF_CHANNEL,
    CENTER_FREQUENCY,
    CHANNEL_NUMBER,
    IEEE802154,
    INTERFACE_TYPENAME,
    NUM_WLAN_INTERFACES,
    OF_802154,
    WLAN_KEYS,
    at_interface,
)
from gradysim.scenario.lookup import Candidates, Found, Lookup, SettingReader, read_struct
from gradysim.scenario.node_spec import STRUCTS, InterfaceSpec
from gradysim.scenario.parameter_types import BAND, CHANNELS
from gradysim.scenario.schema import Key


def interface_count(name: str, lookup: Lookup, settings: SettingReader, errors: ErrorCollector) -> int:
    """Return the number of interfaces of a node. `errors` takes the error of a bad number."""
    found = lookup.first(name, NUM_WLAN_INTERFACES.path)
    if found is not None and not found.is_default:
        with errors.collecting():
            path = f"{name}.{NUM_WLAN_INTERFACES.path}"
            return int(settings.scalar(found.entry, NUM_WLAN_INTERFACES.kind, path))
    return 1


class InterfaceBuilder:
    """Makes the interfaces of nodes."""

    def __init__(self, lookup: Lookup, settings: SettingReader, errors: ErrorCollector) -> None:
        """Read values with `settings`; `errors` takes the errors."""
        self._lookup = lookup
        self._settings = settings
        self._errors = errors
        self._keys: list[list[tuple[Key, Candidates]]] = []  # of each interface: those that some entry sets
        self._known: dict[object, InterfaceSpec] = {}

    def interfaces(self, node: str, count: int) -> tuple[InterfaceSpec, ...]:
        """Return the `count` interfaces of that node."""
        return tuple(self._interface(node, index, count) for index in range(count))

    def _interface(self, node: str, index: int, count: int) -> InterfaceSpec:
        while len(self._keys) <= index:
            paths = ((key, at_interface(key.path, len(self._keys))) for key in WLAN_KEYS)
            self._keys.append(
                [(key, candidates) for key, path in paths if (candidates := self._lookup.candidates(path))]
            )
        in_force = [(key, candidates.first(node)) for key, candidates in self._keys[index]]
        found = {key: entry for key, entry in in_force if entry is not None}
        own = (node, index) if any(entry.differs for entry in found.values()) else None
        known = (own, *((key.path, entry) for key, entry in found.items()))
        spec = self._known.get(known)
        if spec is None:

            def path_of(key: Key) -> str:
                return f"{node}.{at_interface(key.path, index)}"

            try:
                is_802154 = self._is_802154(found)
                in_band = _of_802154(found) if is_802154 else self._in_its_band(found, path_of)
            except ConfigError as error:  # the numbers of channels have no meaning then
                self._errors.add(error)
                is_802154, in_band = False, {key: found[key] for key in found if key != CHANNEL_NUMBER}
            errors = ErrorCollector()
            structs = {
                struct: read_struct(struct, in_band, self._settings, path_of, errors) for struct in STRUCTS
            }
            channel = found.get(CHANNEL_NUMBER)
            for of_field in errors.errors:
                is_of_channel = channel is not None and channel.entry.source == of_field.source
                if is_of_channel and self._has_typenames():
                    of_field = _of_one_kind_only(of_field, node, index, count, is_802154)
                self._errors.add(of_field)
            spec = self._known[known] = InterfaceSpec(**structs, range_sets_power=_range_comes_first(found))
        return spec

    def _has_typenames(self) -> bool:
        """Return whether there may be interfaces of both kinds."""
        return bool(self._lookup.candidates(INTERFACE_TYPENAME.path))

    def _is_802154(self, found: Mapping[Key, Found]) -> bool:
        chosen = found.get(INTERFACE_TYPENAME)
        if chosen is None or chosen.is_default:
            return False
        return self._settings.scalar(chosen.entry, INTERFACE_TYPENAME.kind) in IEEE802154.names

    def _in_its_band(self, found: Mapping[Key, Found], path_of: Callable[[Key], str]) -> Mapping[Key, Found]:
        """Read the number of a channel as one of the band that is set with it.

        A band has no further effect if a channel or its center is set.
        """
        written = {key: entry for key, entry in found.items() if not entry.is_default}
        band = written.get(BAND_NAME)
        channel, centre = written.get(CHANNEL_NUMBER), written.get(CENTER_FREQUENCY)
        if band is None or (channel is None and centre is None):
            return found
        name = str(self._settings.scalar(band.entry, BAND, path_of(BAND_NAME)))
        in_band = {key: entry for key, entry in found.items() if key not in (BAND_NAME, CHANNEL_NUMBER)}
        if channel is not None:
            in_band[replace(CHANNEL_NUMBER, kind=CHANNELS[name])] = channel
        if centre is None or (channel is not None and channel.order < centre.order):
            in_band[BAND_OF_CHANNEL] = band
        elif not centre.overrides(band):
            in_band[BAND_BESIDE_FREQUENCY] = band
        return in_band


def _of_802154(found: Mapping[Key, Found]) -> Mapping[Key, Found]:
    """Read the number of a channel as one of 802.15.4, which has one band."""
    return {OF_802154.get(key, key): entry for key, entry in found.items()}


def _is_about_this_alone(key: str, node: str, index: int, count: int) -> bool:
    """Return whether a key names a node's group and, of several interfaces, this one."""
    group = node.partition("[")[0]
    return key.startswith((f"*.{group}.", f"*.{group}[")) and (count == 1 or f".wlan[{index}]." in key)


def _of_one_kind_only(error: ConfigError, node: str, index: int, count: int, is_802154: bool) -> ConfigError:
    """Add a hint to an error of a channel: the standards number them differently, `**` matches both."""
    if _is_about_this_alone(error.key, node, index, count):
        return error
    kind, other = ("802.15.4", "802.11") if is_802154 else ("802.11", "802.15.4")
    group, bracket, _ = node.partition("[")
    line = f"*.{group}{bracket and '[*]'}.{at_interface(CHANNEL_NUMBER.path, index)} = default"
    hint = f", since wlan[{index}] of {node} is of {kind}; the line `{line}` before it leaves it to {other}"
    return error.with_hint(hint)


def _range_comes_first(found: Mapping[Key, Found]) -> bool:
    """Return whether a range is set, and not after a power."""
    orders = {key.field: entry.order for key, entry in found.items() if not entry.is_default}
    at = orders.get("communication_range_m")
    return at is not None and at <= orders.get("tx_power_w", at)
