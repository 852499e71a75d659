"""The frequency bands of 802.11 radios under INET's names, and the centres of their channels, counted from 0.

802.15.4 radios have one band, whose channels have the numbers of the standard, from 11 on.

The channels of the 2.4 GHz band are those of the standard. The other bands are cut into channels of equal
width, as INET cuts them: centre = start + (number + 1/2) * width. In the 5.9 GHz band these are channels 172,
174, ... 184 of IEEE 802.11-2020, annex E; in the bands of 5 GHz they are not: there centerFrequency says
which is meant (channel 36: 5180 MHz).
"""

from dataclasses import replace

from gradysim.scenario.errors import BadValue
from gradysim.scenario.expressions import parse_value
from gradysim.scenario.functions import Value
from gradysim.scenario.parameter_types import ParameterType, Scalar, choice, integer
from gradysim.scenario.units import Quantity


def _channel_of_2_4_ghz() -> ParameterType:
    """A channel of the 2.4 GHz band, counted from 0 as INET does, converted to its centre in hertz.

    The centres are those of IEEE 802.11-2020, 15.4.4.3: 2.412 GHz and every 5 MHz from there, the 14th at
    2.484 GHz.
    """
    index = integer(0, 13)

    def convert(value: Value) -> float:
        try:
            channel = int(index.convert(value))
        except BadValue as error:
            raise BadValue(
                error.problem, error.hint or _hint_at_5_ghz(value), suggestion=error.suggestion
            ) from None
        return 2.484e9 if channel == 13 else 2.412e9 + 5e6 * channel

    def show(carrier_hz: Scalar) -> str:
        if carrier_hz == 2.484e9:
            return "13"
        channel = (float(carrier_hz) - 2.412e9) / 5e6
        return f"{channel:g}" if channel.is_integer() else "none"

    expected = "a channel of the 2.4 GHz band, 0 (2.412 GHz) to 13"
    return ParameterType(expected, convert, unit="0 to 13", show=show)


def _hint_at_5_ghz(value: Value) -> str:
    """For a number that only the 5 GHz band has: centre 5 GHz + 5 MHz each (IEEE 802.11-2020, annex E)."""
    if isinstance(value, Quantity) and value.unit is None and value.number in range(36, 178):
        return (
            f"; channel {value} of the 5 GHz band is `radio.centerFrequency = {5000 + 5 * value.number}MHz`"
        )
    return ""


def _channel(band: str, start_hz: float, width_hz: float, count: int) -> ParameterType:
    """A channel of a band of equal channels, converted to its centre in hertz."""
    index = integer(0, count - 1)

    def convert(value: Value) -> float:
        return start_hz + (int(index.convert(value)) + 0.5) * width_hz

    first_mhz = (start_hz + width_hz / 2) / 1e6
    expected = f'a channel of the band "{band}", 0 ({first_mhz:g} MHz) to {count - 1}'
    return ParameterType(expected, convert, unit=f"0 to {count - 1}")


CHANNELS = {
    "2.4 GHz": _channel_of_2_4_ghz(),
    **{
        name: _channel(name, start_hz, width_hz, count)
        for name, start_hz, width_hz, count in (
            ("5 GHz", 5e9, 5e6, 200),
            ("5 GHz (20 MHz)", 5e9, 20e6, 25),
            ("5 GHz (40 MHz)", 5e9, 40e6, 12),
            ("5 GHz (80 MHz)", 5e9, 80e6, 5),
            ("5 GHz (160 MHz)", 5e9, 160e6, 2),
            ("5.9 GHz", 5.855e9, 10e6, 7),
        )
    },
}
"""The kind of a channel's number, by the name of its band."""

_FIRST_OF_802154, _LAST_OF_802154 = 11, 26


def _channel_of_802154() -> ParameterType:
    """A channel of IEEE 802.15.4 in the 2450 MHz band, converted to its centre in hertz.

    The centre of channel k is 2405 + 5 (k - 11) MHz (IEEE 802.15.4-2006, 6.1.2.1).
    """
    number = integer(_FIRST_OF_802154, _LAST_OF_802154)

    def convert(value: Value) -> float:
        return 2.405e9 + 5e6 * (int(number.convert(value)) - _FIRST_OF_802154)

    def show(carrier_hz: Scalar) -> str:
        channel = (float(carrier_hz) - 2.405e9) / 5e6 + _FIRST_OF_802154
        is_one = channel.is_integer() and _FIRST_OF_802154 <= channel <= _LAST_OF_802154
        return f"{channel:g}" if is_one else "none"

    numbers = f"{_FIRST_OF_802154} to {_LAST_OF_802154}"
    return ParameterType(
        f"a channel of IEEE 802.15.4, {numbers} (2.405 GHz to 2.48 GHz)", convert, unit=numbers, show=show
    )


CHANNEL_OF_802154 = _channel_of_802154()
"""The kind of a channel's number of an 802.15.4 radio."""


def channel_by_default() -> ParameterType:
    """The kind of a channel's number where no band is said; lists of keys show those of both standards."""
    of_80211 = CHANNELS["2.4 GHz"]

    def show(carrier_hz: Scalar) -> str:
        channel = of_80211.show(carrier_hz)
        return channel if channel != "none" else CHANNEL_OF_802154.show(carrier_hz)

    return replace(of_80211, unit=f"{of_80211.unit}; 802.15.4: {CHANNEL_OF_802154.unit}", show=show)


BAND = choice(*CHANNELS)
"""The name of a band."""


def first_channel_of_band() -> ParameterType:
    """The name of a band, converted to the centre of its channel 0 in hertz."""
    centres_hz = {name: channel.convert(parse_value("0")) for name, channel in CHANNELS.items()}
    names = {centre_hz: BAND.show(name) for name, centre_hz in centres_hz.items()}
    return replace(
        BAND,
        convert=lambda value: centres_hz[str(BAND.convert(value))],
        show=lambda carrier_hz: names.get(carrier_hz, "none"),
    )
