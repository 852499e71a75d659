"""Keys of a radio: its channel, what it sends and what it receives."""

from dataclasses import replace

from gradysim.scenario.keys.antenna import ANTENNA_KEYS
from gradysim.scenario.keys.bands import CHANNEL_OF_802154, channel_by_default, first_channel_of_band
from gradysim.scenario.keys.interface import IEEE80211, WLAN
from gradysim.scenario.keys.key import Key
from gradysim.scenario.keys.radio_media import RADIO_MEDIA
from gradysim.scenario.keys.receiver import RECEIVER_KEYS
from gradysim.scenario.keys.shapes import Below
from gradysim.scenario.parameter_types import quantity

_own = Below(f"{WLAN}.radio", "radio", RADIO_MEDIA)
_of_all_media = Below(f"{WLAN}.radio", "radio")

CENTER_FREQUENCY = _own(
    "centerFrequency", "carrier_hz", quantity("Hz", above=0, shown="MHz"), "Centre of the channel"
)
BAND_NAME = _own(
    "bandName",
    "carrier_hz",
    first_channel_of_band(),
    "802.11: band that channelNumber counts in; without that, channel 0 of it",
)
CHANNEL_NUMBER = _own(
    "channelNumber",
    "carrier_hz",
    channel_by_default(),
    "Channel of the band (another way to set centerFrequency). 802.11: counted from 0, up to 13 in the"
    " 2.4 GHz band, without bandName; other bands are counted as in INET (docs/guides/interfaces.md)."
    " 802.15.4: number of the standard, 11 (2405 MHz) to 26 (2480 MHz)",
)

OF_802154: dict[Key, Key] = {
    CHANNEL_NUMBER: replace(CHANNEL_NUMBER, kind=CHANNEL_OF_802154),
    BAND_NAME: replace(BAND_NAME, target="band.band_name", read_by=IEEE80211),
}
"""What stands for these two keys at an 802.15.4 interface, which has one band and reads no name."""

BAND_OF_CHANNEL = replace(BAND_NAME, target="band.of_channel")
BAND_BESIDE_FREQUENCY = replace(BAND_NAME, target="band.beside_frequency")
"""What stands for the name of a band at an 802.11 interface with a channel in it, or with a frequency."""

RADIO_KEYS: tuple[Key, ...] = (
    BAND_NAME,
    CHANNEL_NUMBER,
    CENTER_FREQUENCY,
    _own("bandwidth", "bandwidth_hz", quantity("Hz", above=0, shown="MHz"), "Width of the channel"),
    _own("transmitter.power", "tx_power_w", quantity("W", at_least=0, shown="mW"), "Power that is sent"),
    _of_all_media(
        "transmitter.communicationRange",
        "communication_range_m",
        quantity("m", at_least=0),
        "UnitDiskRadioMedium: radius of the circle. Other media: sets the least power for which at least"
        " half of the broadcast messages of 50 B arrive there; of it and transmitter.power the first line is"
        " in force",
    ),
    *RECEIVER_KEYS,
    *ANTENNA_KEYS,
)
