"""Functions that draw the value of a parameter: `uniform(0m, 1km)`, by OMNeT++'s names and arguments.

The distributions are our own, so that results agree on every platform. All values of a call measure the same,
and so does the number that is drawn, but for a plain number that comes first: the shape of `erlang_k(3, 1s)`.

Continuous ones of which nothing else is said are drawn by the inverse of their distribution function.
Source: L. Devroye, "Non-Uniform Random Variate Generation", 1986, II.2.
"""

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.operators import Value
from gradysim.scenario.value.parameter_stream import ParameterStream
from gradysim.scenario.value.quantity import Number, Quantity
from gradysim.scenario.value.quoted import QUOTED
from gradysim.scenario.value.units import Dimension

_MOST_INTEGERS = 2**64
_MOST_TO_ADD = 10_000
"""Random numbers that one draw adds up."""
_FARTHEST = 3.0
"""Standard deviations by which the mean of `truncnormal` may be negative: from there on fewer than one in a
thousand numbers would be left."""


@dataclass(frozen=True)
class _Function:
    """One function.

    Attributes:
        written: How it is written, with the names of its values.
        draw: What draws, for values in one unit.
        has_shape: Whether its first value is a plain number, whatever the others measure.
    """

    written: str
    draw: Callable[[ParameterStream, Sequence[Quantity]], Number]
    has_shape: bool = False

    @property
    def value_count(self) -> int:
        return self.written.count(",") + 1


def draw(name: str, given: Sequence[Value], stream: ParameterStream) -> Quantity:
    """The number that the function of that name draws, in the unit of its values.

    Raises:
        BadValue: The values do not go with the function or with each other.
    """
    function = DRAWING_FUNCTIONS[name]
    values = [value for value in given if isinstance(value, Quantity)]
    if len(values) < len(given):
        raise BadValue(f"`{name}` takes numbers only")
    if len(values) != function.value_count:
        one_more = len(values) == function.value_count + 1
        hint = "; generators have no numbers here, each parameter has its own" if one_more else ""
        takes = f"{function.value_count} value{'' if function.value_count == 1 else 's'}"
        raise BadValue(f"`{function.written}` takes {takes}, not {len(values)}", hint)
    try:
        shape, others = (values[:1], values[1:]) if function.has_shape else ([], values)
        if shape and shape[0].unit is not None:
            raise BadValue(f"`{shape[0]}` is no plain number")
        number = function.draw(stream, [*_in_one_unit(shape), *_in_one_unit(others)])
        if not math.isfinite(number):
            raise OverflowError
    except BadValue as error:
        raise error.with_problem(f"`{name}`: {error.problem}") from None
    except (OverflowError, ZeroDivisionError):
        raise BadValue(f"`{name}`: it has drawn a number that is too large") from None
    return Quantity(number, others[0].unit)


def drawing_function_in(text: str) -> str:
    """The name of the first function that a value calls, or "" if it draws nothing."""
    return next((match[1] for match in _CALL_OR_TEXT.finditer(text) if match[1]), "")


def _in_one_unit(values: Sequence[Quantity]) -> list[Quantity]:
    """The values in the unit of the first one; all are finite."""
    for value in values:
        if not math.isfinite(value.number):
            raise BadValue(f"`{value}` is not finite")
    return [value if value.unit == values[0].unit else _converted(value, values[0]) for value in values]


def _converted(value: Quantity, first: Quantity) -> Quantity:
    if first.unit is None or value.unit is None or first.unit.dimension is not value.unit.dimension:
        hint = _level_meant(value, first)
        raise BadValue(f"`{first}` and `{value}` measure different things", hint)
    if first.unit.logarithmic or value.unit.logarithmic:
        raise BadValue(f"`{first}` and `{value}` have different units, and one is a logarithm")
    return Quantity(0, first.unit).plus(value)


def _level_meant(value: Quantity, first: Quantity) -> str:
    """A hint for `normal(10dBm, 3dB)`: what spreads a level by 3 dB is written like the level itself."""
    if value.unit is None or value.unit.dimension is not Dimension.LEVEL:
        return ""
    is_level = first.unit is not None and first.unit.logarithmic
    return f"; did you mean `{Quantity(value.number, first.unit)}`?" if is_level else ""


def _uniform(stream: ParameterStream, values: Sequence[Quantity]) -> float:
    """In [a, b): a + (b - a) u with u uniform in [0, 1); a if both are equal."""
    low, high = _ordered(values)
    start, end = float(low.number), float(high.number)
    if not math.isfinite(end - start):
        raise BadValue(f"`{low}` and `{high}` are too far apart")
    number = start + (end - start) * stream.uniform()
    return min(number, math.nextafter(end, start))  # which the sum may be rounded to


def _intuniform(stream: ParameterStream, values: Sequence[Quantity]) -> int:
    """One of the whole numbers a … b, both included."""
    low, high = _ordered(values)
    first, last = _whole(low), _whole(high)
    if last - first >= _MOST_INTEGERS:
        raise BadValue(f"`{low}` and `{high}` are too far apart")
    return first + stream.uniform_int(last - first + 1)


def _exponential(stream: ParameterStream, values: Sequence[Quantity]) -> float:
    """-mean ln(1 - u)."""
    return _not_negative(values[0], "mean") * _exponential_of_mean_1(stream)


def _exponential_of_mean_1(stream: ParameterStream) -> float:
    return -math.log(1.0 - stream.uniform())


def _normal(stream: ParameterStream, values: Sequence[Quantity]) -> float:
    """Mean + stddev r cos(2 pi v) with r = sqrt(-2 ln(1 - u)), as the engine's fading has it.

    Source: G. E. P. Box, M. E. Muller, "A note on the generation of random normal deviates", Annals of
    Mathematical Statistics 29, 1958.
    """
    mean, deviation = float(values[0].number), _not_negative(values[1], "standard deviation")
    u, v = stream.uniform_pair()
    return mean + deviation * (math.sqrt(-2.0 * math.log(1.0 - u)) * math.cos(2.0 * math.pi * v))


def _truncnormal(stream: ParameterStream, values: Sequence[Quantity]) -> float:
    """The part of the normal distribution that is not negative: drawn again until it is."""
    mean, deviation = float(values[0].number), _not_negative(values[1], "standard deviation")
    if mean < -_FARTHEST * deviation:
        given = f"a mean of `{values[0]}` and a standard deviation of `{values[1]}`"
        raise BadValue(f"with {given} not one number in a thousand is positive")
    while (number := _normal(stream, values)) < 0:
        pass
    return number


def _lognormal(stream: ParameterStream, values: Sequence[Quantity]) -> float:
    """Exp of a normally distributed number."""
    if values[0].unit is not None:
        raise BadValue(f"`{values[0]}` is no plain number")
    return math.exp(_normal(stream, values))


def _triang(stream: ParameterStream, values: Sequence[Quantity]) -> float:
    """Density that rises from a to its peak at b and falls to c, in straight lines."""
    low, peak, high = values
    _ordered((low, peak))
    _ordered((peak, high))
    start, middle, end = (float(value.number) for value in values)
    u = stream.uniform()
    if end == start:
        return start
    if u * (end - start) < middle - start:
        return start + math.sqrt(u * (end - start)) * math.sqrt(middle - start)
    return end - math.sqrt((1 - u) * (end - start)) * math.sqrt(end - middle)


def _weibull(stream: ParameterStream, values: Sequence[Quantity]) -> float:
    """The number a (-ln(1 - u))^(1 / b): scale a, shape b, which as in OMNeT++ has the unit of the scale."""
    scale, shape = _positive(values[0], "scale"), _positive(values[1], "shape")
    return scale * math.pow(_exponential_of_mean_1(stream), 1 / shape)


def _pareto_shifted(stream: ParameterStream, values: Sequence[Quantity]) -> float:
    """The number b / (1 - u)^(1 / a) - c: shape a, scale b, shifted down by c."""
    shape, scale = _positive(values[0], "shape"), _positive(values[1], "scale")
    return scale / math.pow(1.0 - stream.uniform(), 1 / shape) - float(values[2].number)


def _cauchy(stream: ParameterStream, values: Sequence[Quantity]) -> float:
    """The number a + b tan(pi (u - 1/2)): median a, half width b at half of the peak."""
    width = _positive(values[1], "width")
    return float(values[0].number) + width * math.tan(math.pi * (stream.uniform() - 0.5))


def _erlang_k(stream: ParameterStream, values: Sequence[Quantity]) -> float:
    """The sum of k exponentially distributed numbers, with that mean together."""
    count = _count(values[0], "k")
    mean = _not_negative(values[1], "mean")
    return mean / count * sum(_exponential_of_mean_1(stream) for _ in range(count))


def _bernoulli(stream: ParameterStream, values: Sequence[Quantity]) -> int:
    """1 with probability p, else 0."""
    return int(stream.uniform() < _probability(values[0]))


def _geometric(stream: ParameterStream, values: Sequence[Quantity]) -> int:
    """How often something of probability p fails before it succeeds."""
    p = _probability(values[0])
    if p == 0:
        raise BadValue("with the probability `0` it would never end")
    return 0 if p == 1 else math.floor(_exponential_of_mean_1(stream) / -math.log1p(-p))


def _poisson(stream: ParameterStream, values: Sequence[Quantity]) -> int:
    """How many exponentially distributed intervals of mean 1 end within the mean."""
    if values[0].unit is not None:
        raise BadValue(f"`{values[0]}` is no plain number")
    rest = _not_negative(values[0], "mean")
    if rest > _MOST_TO_ADD:
        raise BadValue(f"the mean `{values[0]}` is too large", expected=f"at most {_MOST_TO_ADD}")
    count = 0
    while (rest := rest - _exponential_of_mean_1(stream)) > 0:
        count += 1
    return count


def _ordered(values: Sequence[Quantity]) -> tuple[Quantity, Quantity]:
    low, high = values
    if low.number > high.number:
        raise BadValue(f"`{low}` is more than `{high}`", "; the smaller one comes first")
    return low, high


def _whole(value: Quantity) -> int:
    if isinstance(value.number, int):
        return value.number
    if isinstance(value.number, Fraction) and value.number.denominator == 1:  # of another unit, 1km in metres
        return value.number.numerator
    raise BadValue(f"`{value}` is no whole number")


def _not_negative(value: Quantity, what: str) -> float:
    if value.number < 0:
        raise BadValue(f"the {what} `{value}` is negative")
    return float(value.number)


def _positive(value: Quantity, what: str) -> float:
    if not value.number > 0:
        raise BadValue(f"the {what} `{value}` is not positive")
    return float(value.number)


def _probability(value: Quantity) -> float:
    if value.unit is not None or not 0 <= value.number <= 1:
        raise BadValue(f"`{value}` is no probability", expected="0 to 1")
    return float(value.number)


def _count(value: Quantity, name: str) -> int:
    count = _whole(value)
    if not 1 <= count <= _MOST_TO_ADD:
        raise BadValue(f"{name} = `{value}` is out of range", expected=f"1 to {_MOST_TO_ADD}")
    return count


DRAWING_FUNCTIONS: dict[str, _Function] = {
    "uniform": _Function("uniform(a, b)", _uniform),
    "intuniform": _Function("intuniform(a, b)", _intuniform),
    "exponential": _Function("exponential(mean)", _exponential),
    "normal": _Function("normal(mean, stddev)", _normal),
    "truncnormal": _Function("truncnormal(mean, stddev)", _truncnormal),
    "lognormal": _Function("lognormal(m, w)", _lognormal),
    "triang": _Function("triang(a, b, c)", _triang),
    "weibull": _Function("weibull(a, b)", _weibull),
    "cauchy": _Function("cauchy(a, b)", _cauchy),
    "pareto_shifted": _Function("pareto_shifted(a, b, c)", _pareto_shifted, has_shape=True),
    "erlang_k": _Function("erlang_k(k, mean)", _erlang_k, has_shape=True),
    "bernoulli": _Function("bernoulli(p)", _bernoulli),
    "geometric": _Function("geometric(p)", _geometric),
    "poisson": _Function("poisson(mean)", _poisson),
}
"""By name."""

_CALL_OR_TEXT = re.compile(rf"{QUOTED}|\b({'|'.join(DRAWING_FUNCTIONS)})\s*\(", re.ASCII | re.DOTALL)
