"""Keys of a radio: its channel, what it sends and what it receives."""

from gradysim.config.key import Key
from gradysim.config.keys.antenna import ANTENNA_KEYS
from gradysim.config.keys.interface import WLAN
from gradysim.config.keys.radio_media import RADIO_MEDIA
from gradysim.config.keys.receiver import RECEIVER_KEYS
from gradysim.config.keys.shapes import Below
from gradysim.config.kinds import channel_of_2_4_ghz, quantity

_own = Below(f"{WLAN}.radio", "radio", RADIO_MEDIA)
_of_all_media = Below(f"{WLAN}.radio", "radio")

RADIO_KEYS: tuple[Key, ...] = (
    _own(
        "channelNumber",
        "carrier_hz",
        channel_of_2_4_ghz(),
        "802.11: channel of the 2.4 GHz band, counted from 0 (another way to set centerFrequency)",
    ),
    _own("centerFrequency", "carrier_hz", quantity("Hz", above=0, shown="MHz"), "Centre of the channel"),
    _own("bandwidth", "bandwidth_hz", quantity("Hz", above=0, shown="MHz"), "Width of the channel"),
    _own("transmitter.power", "tx_power_w", quantity("W", at_least=0, shown="mW"), "Power that is sent"),
    _of_all_media(
        "transmitter.communicationRange",
        "communication_range_m",
        quantity("m", at_least=0),
        "UnitDiskRadioMedium: radius of the circle. Other media: sets the power for which half of the"
        " broadcast messages of 50 B arrive there; of it and transmitter.power the first line is in force",
    ),
    *RECEIVER_KEYS,
    *ANTENNA_KEYS,
)
