"""A number with a unit. Exact until it is converted, so that 0.3ms is the same double as 0.0003s."""

import math
from dataclasses import dataclass
from fractions import Fraction

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.decibels import db_from_ratio, ratio_from_db
from gradysim.scenario.value.units import Dimension, Unit

Number = int | Fraction | float
"""An int was written without point and exponent; a Fraction is any other exact number; a float is inf, nan
or a rounded result."""


@dataclass(frozen=True)
class Quantity:
    """A number and its unit, None for a plain number. BadValue if no double is as large as the number."""

    number: Number
    unit: Unit | None = None

    def __post_init__(self) -> None:
        try:
            float(self.number)
        except OverflowError:
            raise BadValue("the result is too large for a number") from None

    def __str__(self) -> str:
        number = self.number if isinstance(self.number, int) else float(self.number)
        return f"{number}{self.unit.name if self.unit else ''}"

    def to(self, unit: Unit) -> float:
        """The number in another unit of the same dimension, rounded once.

        Raises:
            BadValue: The dimensions differ, there is no unit, or the result is no double.
        """
        if self.unit is None:
            raise BadValue(f"`{self}` has no unit")
        if self.unit.dimension is not unit.dimension:
            hint = "; `m` is metres, a minute is `min`" if (self.unit.name, unit.name) == ("m", "s") else ""
            raise BadValue(f"`{self.unit.name}` is the unit of {_plain_name(self.unit.dimension)}{hint}")
        try:
            return float(self._to(unit))
        except OverflowError:
            raise BadValue(f"`{self}` is too large for a number") from None

    def _to(self, unit: Unit) -> Number:
        """The same, but exact if it can be, however large. BadValue if it is rounded, and no double."""
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
        if unit.logarithmic:
            ratio = self.unit.factor / unit.factor
            if self.unit.logarithmic:
                return float(self.number) + db_from_ratio(float(ratio))
            linear = float(self.number * ratio)
            if linear <= 0.0:
                raise BadValue(f"`{self}` has no logarithm, so it is no number of {unit.name}")
            return db_from_ratio(linear)
        if self.unit.logarithmic:
            return ratio_from_db(float(self.number)) * float(self.unit.factor / unit.factor)
        scale = self.unit.factor / unit.factor
        if isinstance(self.number, float):
            return self.number * float(scale)
        exact: Fraction = self.number * scale
        return exact

    def numbers_beside(self, other: "Quantity") -> tuple[Number, Number]:
        """This number and that of another quantity, in the unit of this one, to be compared.

        If one of them is rounded, both are.

        Raises:
            BadValue: The two measure different things, or one is too large to be rounded.
        """
        if self.unit != other.unit and (
            self.unit is None or other.unit is None or self.unit.dimension is not other.unit.dimension
        ):
            raise BadValue(f"`{self}` and `{other}` measure different things and cannot be compared")
        there = other._beside(self)
        return float(self.number) if isinstance(there, float) else self.number, there

    def _beside(self, other: "Quantity") -> Number:
        """The number in the unit of the other quantity, if both have one, and rounded if the other's is."""
        is_rounded = isinstance(other.number, float)
        if self.unit is None or other.unit is None:
            return float(self.number) if is_rounded else self.number
        return self.to(other.unit) if is_rounded else self._to(other.unit)

    def plus(self, other: "Quantity", sign: int = 1) -> "Quantity":
        """The sum, in the unit of this one (the difference for sign = -1)."""
        if self.unit != other.unit:
            if self.unit is None or other.unit is None or self.unit.dimension is not other.unit.dimension:
                raise BadValue(f"`{self}` and `{other}` measure different things and cannot be added")
            if self.unit.logarithmic or other.unit.logarithmic:
                raise BadValue(f"`{self}` and `{other}` cannot be added, one is a logarithm")
        elif self.unit is not None and self.unit.logarithmic:
            raise BadValue(f"`{self}` and `{other}` cannot be added, they are logarithms")
        number = other._beside(self)
        return Quantity(self._finite(self.number + sign * number, number), self.unit)

    def times(self, other: "Quantity") -> "Quantity":
        """The product; one of the two is a plain number."""
        if self.unit is not None and other.unit is not None:
            raise BadValue(f"`{self}` times `{other}` has no unit here")
        return Quantity(self._finite(self.number * other.number, other.number), self.unit or other.unit)

    def over(self, other: "Quantity") -> "Quantity":
        """The quotient; by a plain number, or of two quantities of one dimension."""
        if other.unit is not None and (
            self.unit is None
            or self.unit.dimension is not other.unit.dimension
            or self.unit.logarithmic
            or other.unit.logarithmic
        ):
            raise BadValue(f"`{self}` divided by `{other}` has no unit here")
        divisor = other._beside(self)
        if divisor == 0:
            raise BadValue(f"`{self}` is divided by zero")
        if isinstance(divisor, float):
            quotient: Number = self.number / divisor
        else:
            quotient = Fraction(self.number) / divisor
        return Quantity(self._finite(quotient, divisor), self.unit if other.unit is None else None)

    def _finite(self, result: Number, operand: Number) -> Number:
        """The result of arithmetic. BadValue if it is not finite, though its operands are."""
        if not is_finite(result) and is_finite(self.number) and is_finite(operand):
            raise BadValue("the result is too large for a number")
        return result

    def modulo(self, other: "Quantity") -> "Quantity":
        """The remainder of two plain whole numbers, with the sign of this one, as in C."""
        left, right = self.number, other.number
        if self.unit or other.unit or not (isinstance(left, int) and isinstance(right, int)):
            raise BadValue(
                f"`{self}` % `{other}`: it is for plain whole numbers", "; for others there is `fmod(a, b)`"
            )
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
            raise BadValue("the result is too large for a number") from None
        except (ValueError, ZeroDivisionError):
            raise BadValue(f"`{self}` ^ `{other}` is no number") from None
        return Quantity(result)


def is_finite(number: Number) -> bool:
    """Whether a number is neither inf nor nan, also if no double is as large."""
    return not isinstance(number, float) or math.isfinite(number)


def _is_short(number: Number) -> bool:
    """Whether powers of an exact number stay of a reasonable length."""
    return not isinstance(number, float) and max(abs(number.numerator), number.denominator) < 2**64


def _plain_name(dimension: Dimension) -> str:
    return dimension.value.partition(" such as ")[0]
