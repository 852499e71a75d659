"""What a value has to be: a quantity of some dimension, an integer, one of some names, and so on.

A kind turns the value that was written into what a struct holds: SI units, powers in watts.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from gradysim.protocol.position import LARGEST_COORDINATE_M
from gradysim.scenario.errors import BadValue, nearest
from gradysim.scenario.value.decibels import db_from_ratio, ratio_from_db
from gradysim.scenario.value.operators import Value
from gradysim.scenario.value.quantity import Quantity
from gradysim.scenario.value.units import UNITS, Dimension

Scalar = float | int | str | bool

MAX_INTEGER = 2**31 - 1
_STRONGEST_W = 1


@dataclass(frozen=True, eq=False)
class Kind:
    """A kind of value.

    Attributes:
        expected: How messages name it, after "expected".
        convert: Checks a value and gives what is to be stored; raises BadValue.
        is_text: Whether a text is meant: an override needs no quotes.
        names: Those of which the text is one, if it is.
        is_file: Whether that text is the name of a file, seen from the .ini file.
        unit: For a list of keys: the unit, or what it is instead ("whole number").
        show: Writes what is stored as it would stand in a file, in `unit`.
        has_all_between: Whether all between two values of this kind is of it, and right whatever else the
            file says.
    """

    expected: str
    convert: Callable[[Value], Scalar]
    is_text: bool = False
    names: tuple[str, ...] = ()
    is_file: bool = False
    unit: str = ""
    show: Callable[[Scalar], str] = str
    has_all_between: bool = False


def quantity(
    unit: str,
    at_least: float | None = None,
    above: float | None = None,
    at_most: float | None = None,
    special: float | None = None,
    shown: str = "",
) -> Kind:
    """A finite quantity, converted to `unit` and of a range in that unit; `special` is allowed beside it.

    Lists of keys show it in the unit `shown`, if that is another one.
    """
    target = UNITS[unit]

    def convert(value: Value) -> float:
        number = _quantity_of(value).to(target)
        _check_range(number, value, at_least, above, at_most, special)
        return number

    expected = target.dimension.value + _range_text(at_least, above, at_most, unit)
    return Kind(
        expected + (f", or {special:g}{unit}" if special is not None else ""),
        convert,
        unit=shown or unit,
        show=lambda value: (
            f"{value:g}{unit}" if value == special else _in_unit(float(value), unit, shown or unit)
        ),
    )


def place() -> Kind:
    """A coordinate where a node may be, whatever else is there."""
    return replace(coordinate(), has_all_between=True)


def coordinate() -> Kind:
    """A coordinate within the scene, in metres."""
    return quantity("m", at_least=-LARGEST_COORDINATE_M, at_most=LARGEST_COORDINATE_M)


def angle() -> Kind:
    """How something is turned, in radians."""
    return quantity("rad", shown="deg")


def level(zero: bool = False) -> Kind:
    """A power at a receiver, in watts; `zero` is allowed or not.

    At most 1 W (30 dBm): more than any radio receives, and less than the usual levels without their minus
    sign. The engine has no such bound: in networks built in Python, radios may stand side by side.
    """
    power = quantity("W", at_least=0, shown="dBm") if zero else quantity("W", above=0, shown="dBm")

    def convert(value: Value) -> Scalar:
        power_w = power.convert(value)
        if float(power_w) > _STRONGEST_W:
            raise BadValue(f"`{value}` is more than any radio receives", "; is a minus sign missing?")
        return power_w

    return replace(power, expected=f"{power.expected} and at most {_STRONGEST_W}W", convert=convert)


def number(
    at_least: float | None = None,
    above: float | None = None,
    at_most: float | None = None,
    special: float | None = None,
) -> Kind:
    """A finite number without a unit, of a range; `special` is allowed beside it."""

    def convert(value: Value) -> float:
        result = float(_plain(_quantity_of(value)).number)
        _check_range(result, value, at_least, above, at_most, special)
        return result

    expected = "a plain number" + _range_text(at_least, above, at_most, "")
    return Kind(
        expected + (f", or {special:g}" if special is not None else ""),
        convert,
        unit="number",
        show=lambda value: f"{value:g}",
    )


def integer(
    at_least: int | None = None, at_most: int | None = MAX_INTEGER, special: int | None = None
) -> Kind:
    """An integer, written without a point, of a range; `special` is allowed beside it."""

    def convert(value: Value) -> int:
        result = _plain(_quantity_of(value)).number
        if not isinstance(result, int):
            if math.isfinite(result) and result == int(result):
                hint = f"; did you mean `{int(result)}`, or `int(...)` of an expression?"
                raise BadValue("it is a floating-point number", hint)
            raise BadValue(f"`{value}` is no whole number")
        _check_range(result, value, at_least, None, at_most, special)
        return result

    expected = "a whole number" + _range_text(at_least, None, at_most, "")
    return Kind(expected + (f", or {special}" if special is not None else ""), convert, unit="whole number")


def whole_bytes(at_least: int = 0, at_most: int = MAX_INTEGER) -> Kind:
    """A size, converted to a whole number of bytes."""
    size = quantity("B", at_least=at_least, at_most=at_most)

    def convert(value: Value) -> int:
        result = float(size.convert(value))
        if not result.is_integer():
            raise BadValue(f"`{value}` is no whole number of bytes")
        return int(result)

    return replace(size, convert=convert)


def power_ratio(at_least_db: float = -300) -> Kind:
    """A ratio of powers in decibels, converted to a linear one."""
    decibels = quantity("dB", at_least=at_least_db, at_most=300)
    return replace(
        decibels,
        convert=lambda value: ratio_from_db(float(decibels.convert(value))),
        show=lambda ratio: decibels.show(db_from_ratio(float(ratio))),
    )


def boolean() -> Kind:
    """True or false."""

    def convert(value: Value) -> bool:
        if not isinstance(value, bool):
            raise BadValue(f"it is {_description(value)}")
        return value

    return Kind(
        "true or false", convert, unit="true or false", show=lambda value: "true" if value else "false"
    )


def text() -> Kind:
    """Any text in quotes."""
    return Kind('a text in quotes ("...")', _text_of, is_text=True, unit="text", show=_quoted)


def file_name() -> Kind:
    """The name of a file, in quotes, seen from the folder of the .ini file."""
    return replace(text(), expected='the name of a file in quotes ("...")', is_file=True, unit="file")


def choice(*names: str, otherwise: str = "") -> Kind:
    """One of some texts.

    `otherwise` is said of a text that is none of them misspelt: what does here what other simulators have it
    for.
    """

    def convert(value: Value) -> str:
        name = _text_of(value)
        if name not in names:
            if otherwise and name and not nearest(name, names, strict=True):
                raise BadValue(f"`{name}` is not known", f"; {otherwise}")
            raise BadValue(f"`{name}` is not known", suggestion=nearest(name, names))
        return name

    quoted = [_quoted(name) for name in names]
    expected = f"one of {', '.join(quoted)}" if len(quoted) > 1 else quoted[0]
    return Kind(expected, convert, is_text=True, names=names, unit=expected, show=_quoted)


def si_number() -> Kind:
    """A number, or a quantity, converted to its SI unit; sizes have none, decibels stay as they are."""

    def convert(value: Value) -> float:
        given = _quantity_of(value)
        if given.unit is None:
            return _not_nan(float(given.number), value)
        if given.unit.dimension is Dimension.DATA:
            raise BadValue("bits and bytes have no SI unit")
        base = next(u for u in UNITS.values() if u.dimension is given.unit.dimension and u.factor == 1)
        return _not_nan(given.to(base), value)

    return Kind("a number, or a quantity that has an SI unit", convert, unit="number or quantity")


def number_in(unit: str) -> Kind:
    """A number, taken as it is, or a quantity of that dimension, converted to `unit`."""
    target = UNITS[unit]

    def convert(value: Value) -> float:
        given = _quantity_of(value)
        return _not_nan(float(given.number) if given.unit is None else given.to(target), value)

    return Kind(
        f"{target.dimension.value}, or a number of {unit}",
        convert,
        unit=unit,
        show=lambda value: f"{value:g}{unit}",
    )


def _in_unit(value: float, unit: str, shown: str) -> str:
    """`value`, which is in `unit`, as it is written in the unit `shown`."""
    source, target = UNITS[unit], UNITS[shown]
    number = value * float(source.factor / target.factor)
    if target.logarithmic:
        number = db_from_ratio(number)
    return f"{number:.6g}{shown}"


def _quoted(text: Scalar) -> str:
    return f'"{text}"'


def _quantity_of(value: Value) -> Quantity:
    if not isinstance(value, Quantity):
        raise BadValue(f"it is {_description(value)}")
    return value


def _plain(given: Quantity) -> Quantity:
    if given.unit is None or given.unit.dimension is Dimension.RATIO:
        return given
    raise BadValue(f"it has the unit `{given.unit.name}`")


def _text_of(value: Value) -> str:
    if not isinstance(value, str):
        raise BadValue(f"it is {_description(value)}")
    return value


def _description(value: Value) -> str:
    if isinstance(value, str):
        return "a text"
    if isinstance(value, bool):
        return "a truth value"
    return "a quantity" if value.unit else "a number"


def _not_nan(result: float, value: Value) -> float:
    if math.isnan(result):
        raise BadValue(f"`{value}` is no number")
    return result


def _check_range(
    result: float,
    value: Value,
    at_least: float | None,
    above: float | None,
    at_most: float | None,
    special: float | None,
) -> None:
    if special is not None and result == special:
        return
    if isinstance(result, float) and not math.isfinite(result):
        raise BadValue(f"`{value}` is not finite")
    if (
        (at_least is not None and result < at_least)
        or (above is not None and result <= above)
        or (at_most is not None and result > at_most)
    ):
        raise BadValue("it is out of range")


def _range_text(at_least: float | None, above: float | None, at_most: float | None, unit: str) -> str:
    parts = []
    if at_least is not None:
        parts.append(f"at least {_text_of_bound(at_least)}{unit}")
    if above is not None:
        parts.append(f"greater than {_text_of_bound(above)}{unit}")
    if at_most is not None and at_most != MAX_INTEGER:
        parts.append(f"at most {_text_of_bound(at_most)}{unit}")
    return f", {' and '.join(parts)}" if parts else ""


def _text_of_bound(bound: float) -> str:
    return str(bound) if isinstance(bound, int) else f"{bound:.12g}"
