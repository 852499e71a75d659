"""Keys of which network interfaces a node has."""

import re

from gradysim.protocol.messages.interface_index import MOST_INTERFACES
from gradysim.scenario.keys.key import Key, ReadBy
from gradysim.scenario.keys.radio_media import RADIO_MEDIA
from gradysim.scenario.keys.shapes import Below
from gradysim.scenario.parameter_types import choice, integer

WLAN = "wlan[0]"
"""What the paths of all keys of an interface begin with; for the others see `at_interface`."""

DEFAULT_INTERFACE = "Ieee80211Interface"

IEEE80211 = ReadBy("interface.typename", (DEFAULT_INTERFACE,), shown="")
IEEE802154 = ReadBy("interface.typename", ("Ieee802154NarrowbandInterface",), shown="802.15.4")
"""The kinds of interface, for the keys that only one of them reads."""

_INDEXED = re.compile(r"\bwlan\[(?:0|[1-9]\d*|\d*\.\.\d*)\]", re.ASCII)

NUM_WLAN_INTERFACES = Key(
    "numWlanInterfaces",
    "node.num_wlan_interfaces",
    integer(1, MOST_INTERFACES),
    "Number of its network interfaces: wlan[0], wlan[1], and so on, each on a channel of its own",
    default="1",
)

_own = Below(WLAN, "interface", RADIO_MEDIA)

INTERFACE_TYPENAME = _own(
    "typename",
    "typename",
    choice(*IEEE80211.names, *IEEE802154.names),
    "The network interface: a station of 802.11, or a device of 802.15.4, whose radio has other defaults",
)

INTERFACE_KEYS: tuple[Key, ...] = (INTERFACE_TYPENAME,)


def at_interface(path: str, index: int) -> str:
    """The path of a key of wlan[0] for another interface."""
    return path.replace(WLAN, f"wlan[{index}]", 1)


def interface_in(key: str) -> re.Match[str] | None:
    """Where the key of a line names one interface, or a range: `wlan[1]`, `wlan[2..5]`."""
    return _INDEXED.search(key)


def written_for(text: str, key: str) -> str:
    """A text that says `wlan[*]`, as people write keys, for the interface that `key` is about."""
    interface = interface_in(key)
    return text.replace("wlan[*]", interface[0]) if interface else text
