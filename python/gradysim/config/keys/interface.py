"""Keys of which network interface a node has."""

from gradysim.config.key import Key, ReadBy
from gradysim.config.keys.radio_media import RADIO_MEDIA
from gradysim.config.keys.shapes import Below
from gradysim.config.kinds import choice

WLAN = "wlan[0]"
"""What the paths of all keys of the interface begin with."""

IEEE80211 = ReadBy("node.interface", ("Ieee80211Interface",), shown="")
IEEE802154 = ReadBy("node.interface", ("Ieee802154NarrowbandInterface",), shown="802.15.4")
"""Of which interface a key is."""

_own = Below(WLAN, "node", RADIO_MEDIA)

INTERFACE_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "interface",
        choice(*IEEE80211.names, *IEEE802154.names),
        "Its network interface: a station of 802.11, or a device of 802.15.4, whose radio has other defaults",
    ),
)
