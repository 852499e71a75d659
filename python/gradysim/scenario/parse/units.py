"""Units of .ini files and numbers with units, by OMNeT++'s names.

`d` is a day, `m` a meter, `min` a minute, `B` is eight `b`. `dB` stays a number with the unit dB, since
models disagree about what it is a ratio of; `dBm` and `dBW` are powers. Numbers are exact fractions until
they are converted, so that 0.3ms is the same double as 0.0003s.
"""

import math
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

from gradysim.scenario.errors import BadValue, nearest


class Dimension(Enum):
    """What a unit measures. The value names it in messages, with an example."""

    TIME = "a time such as 10s"
    LENGTH = "a length such as 50m"
    SPEED = "a speed such as 10mps"
    POWER = "a power such as 20mW or -85dBm"
    FREQUENCY = "a frequency such as 2.4GHz"
    BITRATE = "a bitrate such as 24Mbps"
    DATA = "a size such as 100B"
    ANGLE = "an angle such as 90deg"
    LEVEL = "a ratio in decibels such as 4dB"
    RATIO = "a plain number"
    SMALL_RATIO = "a ratio such as 20ppm"
    ENERGY = "an energy such as 10J"
    VOLTAGE = "a voltage such as 12V"
    CURRENT = "a current such as 2A"
    MASS = "a mass such as 2kg"
    TEMPERATURE = "a temperature such as 290K"


@dataclass(frozen=True)
class Unit:
    """A unit. `value` in it is `value * factor` in the SI unit of its dimension.

    A logarithmic unit is `factor * 10 ** (value / 10)` in it instead.
    """

    name: str
    dimension: Dimension
    factor: Fraction
    logarithmic: bool = False


_LINEAR: dict[Dimension, dict[str, Fraction | int | str]] = {
    Dimension.TIME: {
        "s": 1, "d": 86400, "h": 3600, "min": 60, "ms": "1e-3", "us": "1e-6", "ns": "1e-9", "ps": "1e-12",
        "fs": "1e-15", "as": "1e-18",
    },
    Dimension.LENGTH: {"m": 1, "km": 1000, "cm": "1e-2", "mm": "1e-3", "um": "1e-6", "nm": "1e-9"},
    Dimension.SPEED: {"mps": 1, "kmps": 1000, "kmph": Fraction(5, 18), "cmps": "1e-2", "mmps": "1e-3"},
    Dimension.POWER: {
        "W": 1, "GW": "1e9", "MW": "1e6", "kW": 1000, "mW": "1e-3", "uW": "1e-6", "nW": "1e-9", "pW": "1e-12",
        "fW": "1e-15",
    },
    Dimension.FREQUENCY: {"Hz": 1, "kHz": 1000, "MHz": "1e6", "GHz": "1e9", "THz": "1e12"},
    Dimension.BITRATE: {
        "bps": 1, "kbps": 1000, "Mbps": "1e6", "Gbps": "1e9", "Bps": 8, "kBps": 8000, "MBps": "8e6",
        "GBps": "8e9",
    },
    Dimension.DATA: {
        "b": 1, "bit": 1, "kb": 1000, "Mb": "1e6", "Gb": "1e9", "Kib": 2**10, "Mib": 2**20, "Gib": 2**30,
        "B": 8, "byte": 8, "Byte": 8, "kB": 8000, "MB": "8e6", "GB": "8e9", "KiB": 2**13, "MiB": 2**23,
        "GiB": 2**33,
    },
    Dimension.ANGLE: {"rad": 1, "deg": Fraction(math.pi) / 180},
    Dimension.LEVEL: {"dB": 1},
    Dimension.RATIO: {"x": 1},
    Dimension.SMALL_RATIO: {"ppm": 1},
    Dimension.ENERGY: {"J": 1, "kJ": 1000, "MJ": "1e6", "mJ": "1e-3", "Wh": 3600, "kWh": 3600000},
    Dimension.VOLTAGE: {"V": 1, "mV": "1e-3"},
    Dimension.CURRENT: {"A": 1, "mA": "1e-3", "uA": "1e-6"},
    Dimension.MASS: {"kg": 1, "g": "1e-3"},
    Dimension.TEMPERATURE: {"K": 1},
}  # fmt: skip

UNITS: dict[str, Unit] = {
    name: Unit(name, dimension, Fraction(factor))
    for dimension, factors in _LINEAR.items()
    for name, factor in factors.items()
} | {
    name: Unit(name, Dimension.POWER, Fraction(factor), logarithmic=True)
    for name, factor in {"dBW": "1", "dBm": "1e-3", "dBmW": "1e-3"}.items()
}

UNITS_IN_NAMES = (
    "s", "ms", "us", "m", "km", "mps", "kmph", "Hz", "kHz", "MHz", "GHz", "bps", "kbps", "Mbps", "rad", "deg",
    "W", "mW", "dBm", "dBW", "dB",
)  # fmt: skip
"""Those that the end of the name of a protocol's parameter may say, in small letters."""


Number = int | Fraction | float
"""An int was written without point and exponent. A Fraction is any other exact number. A float is inf, nan or
a rounded result."""


def unit_named(name: str) -> Unit:
    """Return the unit of that name. BadValue, with the nearest name, if there is none."""
    if name not in UNITS:
        raise BadValue(f"there is no unit `{name}`", suggestion=nearest(name, UNITS))
    return UNITS[name]


def ratio_from_db(ratio_db: float) -> float:
    """Return 10^(dB/10), as in `cpp/netsim/units.hpp`. OverflowError if no double is as large."""
    return math.pow(10.0, ratio_db / 10.0)


def db_from_ratio(ratio: float) -> float:
    """Return 10 log10(ratio); minus infinity for 0."""
    return 10.0 * math.log10(ratio) if ratio > 0 else -math.inf


def dbm_from_w(power_w: float) -> float:
    """Return a power in dBm (0 dBm is 1 mW); minus infinity for 0 W."""
    return db_from_ratio(power_w * 1000.0)


def is_finite(number: Number) -> bool:
    """Whether a number is neither inf nor nan, also if no double is as large."""
    return not isinstance(number, float) or math.isfinite(number)


@dataclass(frozen=True)
class Quantity:
    """A number and its unit, None for a plain number. BadValue if no double is as large as the number.

    Arithmetic raises BadValue for operands that do not go together, and for results that are not finite
    though the operands are.
    """

    number: Number
    unit: Unit | None = None

    def __post_init__(self) -> None:
        try:
            float(self.number)
        except OverflowError:
            raise BadValue(_TOO_LARGE) from None

    def __str__(self) -> str:
        number = self.number if isinstance(self.number, int) else float(self.number)
        return f"{number}{self.unit.name if self.unit else ''}"

    def has_dimension_of(self, other: "Quantity") -> bool:
        """Whether both measure the same, or both are plain numbers."""
        if self.unit is None or other.unit is None:
            return self.unit is other.unit
        return self.unit.dimension is other.unit.dimension

    def to(self, unit: Unit) -> float:
        """The number in another unit of the same dimension, rounded once.

        Raises:
            BadValue: The dimensions differ, a unit is missing, or the result is not a double.
        """
        if self.unit is None:
            raise BadValue(f"`{self}` has no unit")
        if self.unit.dimension is not unit.dimension:
            hint = "; `m` is meters, a minute is `min`" if (self.unit.name, unit.name) == ("m", "s") else ""
            of_what = self.unit.dimension.value.partition(" such as ")[0]
            raise BadValue(f"`{self.unit.name}` is the unit of {of_what}{hint}")
        try:
            return float(self._in_unit(unit))
        except OverflowError:
            raise BadValue(f"`{self}` is too large for a number") from None

    def _in_unit(self, unit: Unit) -> Number:
        """The number in another unit of the same dimension, exact if it can be, however large."""
        try:
            number = self._converted(unit)
        except OverflowError:
            number = math.inf
        if not is_finite(number) and is_finite(self.number):
            raise BadValue(f"`{self}` is too large for a number")
        return number

    def _converted(self, unit: Unit) -> Number:
        assert self.unit is not None
        if self.unit == unit:
            return self.number
        scale = self.unit.factor / unit.factor
        if unit.logarithmic:
            if self.unit.logarithmic:
                return float(self.number) + db_from_ratio(float(scale))
            linear = float(self.number * scale)
            if linear <= 0.0:
                raise BadValue(f"`{self}` has no logarithm, so it is not a number of {unit.name}")
            return db_from_ratio(linear)
        if self.unit.logarithmic:
            return ratio_from_db(float(self.number)) * float(scale)
        return self.number * (float(scale) if isinstance(self.number, float) else scale)

    def numbers_beside(self, other: "Quantity") -> tuple[Number, Number]:
        """This number and the other one in the unit of this one, to be compared. If one is rounded, both are.

        Raises:
            BadValue: The two measure different things, or one is too large to be rounded.
        """
        if not self.has_dimension_of(other):
            raise BadValue(f"`{self}` and `{other}` measure different things and cannot be compared")
        there = other._beside(self)
        return float(self.number) if isinstance(there, float) else self.number, there

    def _beside(self, other: "Quantity") -> Number:
        """The number in the unit of the other quantity, if both have one, and rounded if the other's is."""
        is_rounded = isinstance(other.number, float)
        if self.unit is None or other.unit is None:
            return float(self.number) if is_rounded else self.number
        return self.to(other.unit) if is_rounded else self._in_unit(other.unit)

    def plus(self, other: "Quantity", sign: int = 1) -> "Quantity":
        """The sum, in the unit of this one (the difference for sign = -1)."""
        both = f"`{self}` and `{other}`"
        if not self.has_dimension_of(other):
            raise BadValue(f"{both} measure different things and cannot be added")
        if any(unit is not None and unit.logarithmic for unit in (self.unit, other.unit)):
            why = "they are logarithms" if self.unit == other.unit else "one is a logarithm"
            raise BadValue(f"{both} cannot be added, {why}")
        number = other._beside(self)
        return self._result(self.number + sign * number, number, self.unit)

    def times(self, other: "Quantity") -> "Quantity":
        """The product; one of the two is a plain number."""
        if self.unit is not None and other.unit is not None:
            raise BadValue(f"`{self}` times `{other}` has no unit here")
        return self._result(self.number * other.number, other.number, self.unit or other.unit)

    def over(self, other: "Quantity") -> "Quantity":
        """The quotient; by a plain number, or of two quantities of one dimension."""
        if other.unit is not None and (
            self.unit is None
            or not self.has_dimension_of(other)
            or self.unit.logarithmic
            or other.unit.logarithmic
        ):
            raise BadValue(f"`{self}` divided by `{other}` has no unit here")
        divisor = other._beside(self)
        if divisor == 0:
            raise BadValue(f"`{self}` is divided by zero")
        dividend = self.number if isinstance(divisor, float) else Fraction(self.number)
        return self._result(dividend / divisor, divisor, self.unit if other.unit is None else None)

    def _result(self, result: Number, operand: Number, unit: Unit | None) -> "Quantity":
        if not is_finite(result) and is_finite(self.number) and is_finite(operand):
            raise BadValue(_TOO_LARGE)
        return Quantity(result, unit)

    def modulo(self, other: "Quantity") -> "Quantity":
        """The remainder of two plain integers, with the sign of this one, as in C."""
        left, right = self.number, other.number
        if self.unit or other.unit or not (isinstance(left, int) and isinstance(right, int)):
            hint = "; for others there is `fmod(a, b)`"
            raise BadValue(f"`{self}` % `{other}`: `%` is for plain integers", hint)
        if right == 0:
            raise BadValue(f"`{self}` is divided by zero")
        remainder = abs(left) % abs(right)
        return Quantity(-remainder if left < 0 else remainder)

    def power(self, other: "Quantity") -> "Quantity":
        """A plain number to the power of a plain number."""
        if self.unit is not None or other.unit is not None:
            raise BadValue(f"`{self}` ^ `{other}`: powers are for plain numbers")
        base, exponent = self.number, other.number
        result: Number
        try:
            if isinstance(exponent, int) and abs(exponent) <= 64 and _is_short(base):
                exact = Fraction(base) ** exponent
                result = int(exact) if isinstance(base, int) and exponent >= 0 else exact
            else:
                result = math.pow(base, exponent)
        except OverflowError:
            raise BadValue(_TOO_LARGE) from None
        except (ValueError, ZeroDivisionError):
            raise BadValue(f"`{self}` ^ `{other}` is not a number") from None
        return Quantity(result)


_TOO_LARGE = "the result is too large for a number"


def _is_short(number: Number) -> bool:
    """Whether powers of an exact number stay of a reasonable length."""
    return not isinstance(number, float) and max(abs(number.numerator), number.denominator) < 2**64
