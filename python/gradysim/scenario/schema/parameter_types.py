"""Types of parameters: a quantity of some dimension, an integer, one of several names, and so on.

A type turns the value that was written into what a struct holds: SI units, powers in watts. Constructors take
keyword arguments: `quantity("s", above=0, shown="ms")`. Bounds are in the unit of the type: `at_least` and
`at_most` are inclusive, `above` is exclusive, and `special` is one more value that is allowed.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from gradysim.protocol.position import LARGEST_COORDINATE_M
from gradysim.scenario.errors import BadValue, nearest
from gradysim.scenario.parse.functions import Value, text_of
from gradysim.scenario.parse.units import UNITS, Dimension, Quantity, db_from_ratio, ratio_from_db

Scalar = float | int | str | bool

MAX_INTEGER = 2**31 - 1
"""The largest `int` of the engine."""

_STRONGEST_W = 1


@dataclass(frozen=True, eq=False)
class ParameterType:
    """Type of a parameter.

    Attributes:
        expected: Its name in messages, after "expected".
        convert: Checks a value and returns the stored value. Raises BadValue.
        is_text: Whether it is a string: an override needs no quotes.
        names: The strings that are allowed, if not all are.
        is_file: Whether the string is the name of a file, relative to the .ini file.
        unit: For a list of keys: the unit, or what it is instead ("integer").
        show: Writes a stored value in the format of a file, in `unit`.
        is_list: Whether it is a list or a tuple.
        has_all_between: Whether every value between two valid values is valid, whatever else the file says.
    """

    expected: str
    convert: Callable[[Value], Scalar]
    is_text: bool = False
    names: tuple[str, ...] = ()
    is_file: bool = False
    unit: str = ""
    show: Callable[[Scalar], str] = str
    has_all_between: bool = False
    is_list: bool = False


@dataclass(frozen=True)
class _Range:
    """The range of a number, and one additional valid value."""

    at_least: float | None = None
    above: float | None = None
    at_most: float | None = None
    special: float | None = None

    def check(self, result: float, value: Value) -> None:
        """Raise BadValue for a number that is out of range or not finite."""
        if self.special is not None and result == self.special:
            return
        if isinstance(result, float) and not math.isfinite(result):
            raise BadValue(f"`{text_of(value)}` is not finite")
        if (
            (self.at_least is not None and result < self.at_least)
            or (self.above is not None and result <= self.above)
            or (self.at_most is not None and result > self.at_most)
        ):
            raise BadValue("it is out of range")

    def text(self, unit: str = "") -> str:
        """The range for a message, ", at least 0m, or -1m"."""
        bounds = (
            ("at least", self.at_least),
            ("greater than", self.above),
            ("at most", None if self.at_most == MAX_INTEGER else self.at_most),
        )
        parts = [f"{name} {_bound(bound)}{unit}" for name, bound in bounds if bound is not None]
        or_special = f", or {self.special:g}{unit}" if self.special is not None else ""
        return (f", {' and '.join(parts)}" if parts else "") + or_special


def _bound(bound: float) -> str:
    return str(bound) if isinstance(bound, int) else f"{bound:.12g}"


def quantity(
    unit: str,
    at_least: float | None = None,
    above: float | None = None,
    at_most: float | None = None,
    special: float | None = None,
    shown: str = "",
) -> ParameterType:
    """Return the type of finite quantities, converted to `unit`. Lists of keys show them in `shown`."""
    target, limits = UNITS[unit], _Range(at_least, above, at_most, special)

    def convert(value: Value) -> float:
        number = _quantity_of(value).to(target)
        limits.check(number, value)
        return number

    def show(value: Scalar) -> str:
        number = float(value)
        return f"{number:g}{unit}" if number == special else _in_unit(number, unit, shown or unit)

    return ParameterType(target.dimension.value + limits.text(unit), convert, unit=shown or unit, show=show)


def _in_unit(value: float, unit: str, shown: str) -> str:
    """Write `value`, which is in `unit`, in the unit `shown`."""
    source, target = UNITS[unit], UNITS[shown]
    number = value * float(source.factor / target.factor)
    return f"{db_from_ratio(number) if target.logarithmic else number:.6g}{shown}"


def coordinate() -> ParameterType:
    """Return the type of coordinates within the scene, in meters."""
    return quantity("m", at_least=-LARGEST_COORDINATE_M, at_most=LARGEST_COORDINATE_M)


def node_coordinate() -> ParameterType:
    """Return the type of coordinates where a node may be, whatever else is there."""
    return replace(coordinate(), has_all_between=True)


def angle() -> ParameterType:
    """Return the type of angles, in radians."""
    return quantity("rad", shown="deg")


def level(zero: bool = False) -> ParameterType:
    """Return the type of powers at a receiver, in watts; `zero` is allowed or not.

    At most 1 W (30 dBm): more than any radio receives, and less than the usual levels without their minus
    sign. The engine has no such bound: in networks built in Python, radios may stand side by side.
    """
    power = quantity("W", at_least=0, shown="dBm") if zero else quantity("W", above=0, shown="dBm")

    def convert(value: Value) -> Scalar:
        power_w = power.convert(value)
        if float(power_w) > _STRONGEST_W:
            raise BadValue(
                f"`{text_of(value)}` is more than any radio receives", "; is a minus sign missing?"
            )
        return power_w

    return replace(power, expected=f"{power.expected} and at most {_STRONGEST_W}W", convert=convert)


def number(
    at_least: float | None = None,
    above: float | None = None,
    at_most: float | None = None,
    special: float | None = None,
) -> ParameterType:
    """Return the type of finite numbers without a unit."""
    limits = _Range(at_least, above, at_most, special)

    def convert(value: Value) -> float:
        result = float(_plain(value).number)
        limits.check(result, value)
        return result

    return ParameterType(
        f"a plain number{limits.text()}", convert, unit="number", show=lambda value: f"{value:g}"
    )


def integer(
    at_least: int | None = None, at_most: int | None = MAX_INTEGER, special: int | None = None
) -> ParameterType:
    """Return the type of integers, written without a point; by default at most an `int` of the engine."""
    limits = _Range(at_least, None, at_most, special)

    def convert(value: Value) -> int:
        result = _plain(value).number
        if not isinstance(result, int):
            if math.isfinite(result) and result == int(result):
                hint = f"; did you mean `{int(result)}`, or `int(...)` of an expression?"
                raise BadValue("it is a floating-point number", hint)
            raise BadValue(f"`{text_of(value)}` is not an integer")
        limits.check(result, value)
        return result

    return ParameterType(f"an integer{limits.text()}", convert, unit="integer")


def whole_bytes(at_least: int = 0, at_most: int = MAX_INTEGER) -> ParameterType:
    """Return the type of sizes, converted to an integer number of bytes."""
    size = quantity("B", at_least=at_least, at_most=at_most)

    def convert(value: Value) -> int:
        result = float(size.convert(value))
        if not result.is_integer():
            raise BadValue(f"`{text_of(value)}` is not an integer number of bytes")
        return int(result)

    return replace(size, convert=convert)


def power_ratio(at_least_db: float = -300) -> ParameterType:
    """Return the type of ratios of powers in decibels, converted to linear ones."""
    decibels = quantity("dB", at_least=at_least_db, at_most=300)
    return replace(
        decibels,
        convert=lambda value: ratio_from_db(float(decibels.convert(value))),
        show=lambda ratio: decibels.show(db_from_ratio(float(ratio))),
    )


def bitrates() -> ParameterType:
    """Return the type of lists of bitrates, in bits per second."""
    bitrate = quantity("bps", above=0, shown="Mbps")

    def convert(value: Any) -> Any:
        return tuple(float(bitrate.convert(element)) for element in _elements(value))

    def show(value: Any) -> str:
        return f"[{', '.join(map(bitrate.show, value))}]"

    return ParameterType(
        "a list of bitrates such as [1Mbps, 2Mbps]",
        convert,
        unit="list of bitrates",
        show=show,
        is_list=True,
    )


def powers_by_bitrate() -> ParameterType:
    """Return the type of lists of pairs: a bitrate in bits per second and a power in watts."""
    bitrate, power = quantity("bps", above=0, shown="Mbps"), quantity("W", at_least=0, shown="mW")

    def pair(value: Any) -> tuple[float, float]:
        elements = _elements(value)
        if len(elements) != 2:
            raise BadValue(f"`{text_of(value)}` is not a pair")
        return float(bitrate.convert(elements[0])), float(power.convert(elements[1]))

    def convert(value: Any) -> Any:
        return tuple(map(pair, _elements(value)))

    def show(value: Any) -> str:
        return f"[{', '.join(f'[{bitrate.show(bps)}, {power.show(watts)}]' for bps, watts in value)}]"

    return ParameterType(
        "a list of bitrates with their powers such as [[48Mbps, 20dBm], [54Mbps, 19dBm]]",
        convert,
        unit="list of bitrates with powers",
        show=show,
        is_list=True,
    )


def _elements(value: Any) -> Sequence[Any]:
    if not isinstance(value, tuple):
        raise BadValue(f"`{text_of(value)}` is a single value")
    return value


def boolean() -> ParameterType:
    """Return the type of true and false."""

    def convert(value: Value) -> bool:
        if not isinstance(value, bool):
            raise BadValue(f"it is {_description(value)}")
        return value

    name = "true or false"
    return ParameterType(name, convert, unit=name, show=lambda value: "true" if value else "false")


def text() -> ParameterType:
    """Return the type of strings in quotes."""
    return ParameterType('a text in quotes ("...")', _string_of, is_text=True, unit="text", show=_quoted)


def file_name() -> ParameterType:
    """Return the type of names of files, in quotes, relative to the folder of the .ini file."""
    return replace(text(), expected='the name of a file in quotes ("...")', is_file=True, unit="file")


def choice(*names: str, otherwise: str = "") -> ParameterType:
    """Return the type of strings that are one of `names`.

    `otherwise` is the hint for a string that is not a misspelling of one of them: what to use here instead
    of what other simulators have under that name.
    """

    def convert(value: Value) -> str:
        name = _string_of(value)
        if name not in names:
            if otherwise and name and not nearest(name, names, strict=True):
                raise BadValue(f"`{name}` is not known", f"; {otherwise}")
            raise BadValue(f"`{name}` is not known", suggestion=nearest(name, names))
        return name

    listed = ", ".join(map(_quoted, names))
    expected = f"one of {listed}" if len(names) > 1 else listed
    return ParameterType(expected, convert, is_text=True, names=names, unit=expected, show=_quoted)


def si_number() -> ParameterType:
    """Return the type of numbers, or quantities converted to SI. Sizes have no SI unit; decibels stay."""

    def convert(value: Value) -> float:
        given = _quantity_of(value)
        if given.unit is None:
            return _not_nan(float(given.number), value)
        if given.unit.dimension is Dimension.DATA:
            raise BadValue("bits and bytes have no SI unit")
        base = next(u for u in UNITS.values() if u.dimension is given.unit.dimension and u.factor == 1)
        return _not_nan(given.to(base), value)

    return ParameterType("a number, or a quantity that has an SI unit", convert, unit="number or quantity")


def number_in(unit: str) -> ParameterType:
    """Return the type of numbers that are taken as they are, or quantities converted to `unit`."""
    target = UNITS[unit]

    def convert(value: Value) -> float:
        given = _quantity_of(value)
        return _not_nan(float(given.number) if given.unit is None else given.to(target), value)

    expected = f"{target.dimension.value}, or a number of {unit}"
    return ParameterType(expected, convert, unit=unit, show=lambda value: f"{value:g}{unit}")


def _quoted(string: Scalar) -> str:
    return f'"{string}"'


def _quantity_of(value: Value) -> Quantity:
    if not isinstance(value, Quantity):
        raise BadValue(f"it is {_description(value)}")
    return value


def _plain(value: Value) -> Quantity:
    given = _quantity_of(value)
    if given.unit is None or given.unit.dimension is Dimension.RATIO:
        return given
    raise BadValue(f"it has the unit `{given.unit.name}`")


def _string_of(value: Value) -> str:
    if not isinstance(value, str):
        raise BadValue(f"it is {_description(value)}")
    return value


def _description(value: Value | tuple[Any, ...]) -> str:
    if isinstance(value, str):
        return "a text"
    if isinstance(value, bool):
        return "a truth value"
    if isinstance(value, tuple):  # an element of a list
        return "a list"
    return "a quantity" if value.unit else "a number"


def _not_nan(result: float, value: Value) -> float:
    if math.isnan(result):
        raise BadValue(f"`{text_of(value)}` is not a number")
    return result


# Channels of the bands of 802.11 radios, under INET's names and counted from 0. The 2.4 GHz band has those of
# the standard. INET cuts the others into channels of equal width. In the 5.9 GHz band these are channels 172,
# 174, ... 184 of IEEE 802.11-2020, annex E. In the bands of 5 GHz they are not those of the standard:
# centerFrequency says which channel is meant (channel 36: 5180 MHz).


def _channel(expected: str, centers_hz: Mapping[int, float]) -> ParameterType:
    """Return the type of the number of a channel, which is converted to its center in hertz."""
    number = integer(min(centers_hz), max(centers_hz))
    numbers = {center_hz: str(channel) for channel, center_hz in centers_hz.items()}
    return ParameterType(
        expected,
        lambda value: centers_hz[int(number.convert(value))],
        unit=f"{min(centers_hz)} to {max(centers_hz)}",
        show=lambda carrier_hz: numbers.get(float(carrier_hz), "none"),
    )


def _channel_of_2_4_ghz() -> ParameterType:
    """A channel of the 2.4 GHz band. Source of the centers: IEEE 802.11-2020, 15.4.4.3."""
    centers_hz = {channel: 2.412e9 + 5e6 * channel for channel in range(13)} | {13: 2.484e9}
    channels = _channel("a channel of the 2.4 GHz band, 0 (2.412 GHz) to 13", centers_hz)

    def convert(value: Value) -> Scalar:
        try:
            return channels.convert(value)
        except BadValue as error:
            number = value.number if isinstance(value, Quantity) and value.unit is None else None
            if not error.hint and isinstance(number, int) and number in range(36, 178):
                # The center of a channel of 5 GHz is 5 GHz + 5 MHz each (IEEE 802.11-2020, annex E).
                key = f"`radio.centerFrequency = {5000 + 5 * number}MHz`"
                raise BadValue(error.problem, f"; channel {number} of the 5 GHz band is {key}") from None
            raise

    return replace(channels, convert=convert)


def _channel_of_equal_width(band: str, start_hz: float, width_hz: float, count: int) -> ParameterType:
    centers_hz = {channel: start_hz + (channel + 0.5) * width_hz for channel in range(count)}
    first = f"0 ({centers_hz[0] / 1e6:g} MHz)"
    return _channel(f'a channel of the band "{band}", {first} to {count - 1}', centers_hz)


CHANNELS = {
    "2.4 GHz": _channel_of_2_4_ghz(),
    **{
        name: _channel_of_equal_width(name, start_hz, width_hz, count)
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
"""The type of a channel's number, by the name of its band."""

CHANNEL_OF_802154 = _channel(
    "a channel of IEEE 802.15.4, 11 to 26 (2.405 GHz to 2.48 GHz)",
    {channel: 2.405e9 + 5e6 * (channel - 11) for channel in range(11, 27)},
)
"""The number of a channel of an 802.15.4 radio, which has one band (IEEE 802.15.4-2006, 6.1.2.1)."""


def channel_by_default() -> ParameterType:
    """Return the type of a channel's number where no band is set. Lists of keys show both standards."""
    of_80211 = CHANNELS["2.4 GHz"]

    def show(carrier_hz: Scalar) -> str:
        channel = of_80211.show(carrier_hz)
        return channel if channel != "none" else CHANNEL_OF_802154.show(carrier_hz)

    return replace(of_80211, unit=f"{of_80211.unit}; 802.15.4: {CHANNEL_OF_802154.unit}", show=show)


BAND = choice(*CHANNELS)
"""The name of a band."""


def first_channel_of_band() -> ParameterType:
    """Return the type of the name of a band, which is converted to the center of its channel 0 in hertz."""
    centers_hz = {name: channel.convert(Quantity(0)) for name, channel in CHANNELS.items()}
    names = {center_hz: BAND.show(name) for name, center_hz in centers_hz.items()}
    return replace(
        BAND,
        convert=lambda value: centers_hz[str(BAND.convert(value))],
        show=lambda carrier_hz: names.get(carrier_hz, "none"),
    )
