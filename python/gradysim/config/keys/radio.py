"""Keys of a radio: its channel, what it sends and what it receives."""

from gradysim.config.bands import CHANNELS, first_channel_of_band
from gradysim.config.key import Key
from gradysim.config.keys.antenna import ANTENNA_KEYS
from gradysim.config.keys.interface import WLAN
from gradysim.config.keys.radio_media import RADIO_MEDIA
from gradysim.config.keys.receiver import RECEIVER_KEYS
from gradysim.config.keys.shapes import Below
from gradysim.config.kinds import quantity

_own = Below(f"{WLAN}.radio", "radio", RADIO_MEDIA)
_of_all_media = Below(f"{WLAN}.radio", "radio")

BAND_NAME = _own(
    "bandName",
    "carrier_hz",
    first_channel_of_band(),
    "802.11: band that channelNumber counts in; without one, channel 0 of it",
)
CHANNEL_NUMBER = _own(
    "channelNumber",
    "carrier_hz",
    CHANNELS["2.4 GHz"],
    "802.11: channel of the band, counted from 0 (another way to set centerFrequency); up to 13 in the"
    " 2.4 GHz band, without bandName; other bands are counted as in INET (docs/guides/interfaces.md)",
)

RADIO_KEYS: tuple[Key, ...] = (
    BAND_NAME,
    CHANNEL_NUMBER,
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
