"""Keys of which network interface a node has."""

from gradysim.config.key import Key
from gradysim.config.keys.shapes import Below
from gradysim.config.kinds import choice

WLAN = "wlan[0]"
"""What the paths of all keys of the interface begin with."""

_own = Below(WLAN, "node")

INTERFACE_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "interface",
        choice("Ieee80211Interface", "Ieee802154NarrowbandInterface"),
        "Its network interface: a station of 802.11, or a device of 802.15.4, whose radio has other defaults",
    ),
)
