"""Random values of parameters, `uniform(0m, 1km)`: the distributions by OMNeT++'s names, and their streams.

The distributions are our own, so that results agree on every platform. All values of a call measure the same,
and so does the number that is drawn. The exception is a shape that comes first, `erlang_k(3, 1s)`: it is a
plain number. Continuous distributions are drawn by the inverse of their distribution function unless noted.
Source: L. Devroye, "Non-Uniform Random Variate Generation", 1986, II.2.
"""

import hashlib
import math
import re
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import NamedTuple

from gradysim.encapsulator.random_stream import Purpose, Words, philox4x32
from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.functions import QUOTED, Value, check_count
from gradysim.scenario.parse.units import Dimension, Number, Quantity

_MASK_32 = 0xFFFF_FFFF
_MOST_INTEGERS = 2**64
_MOST_TO_ADD = 10_000
"""Random numbers that one draw adds up."""
_FARTHEST = 3.0
"""Standard deviations by which the mean of `truncnormal` may be negative.

Beyond that fewer than one number in a thousand would be left."""


class ParameterStream:
    """Random bits for one draw of one value, by blocks of the engine's generator.

    A stream depends on the seed of the run, the path of the parameter (`uavs[3].mobility.initialX`) and the
    number of the draw in its value. Other nodes, other parameters and the order of reading change nothing.
    """

    def __init__(self, seed: int, path: str, index: int) -> None:
        """Start at the first block. `index` counts the draws in the value, from 0."""
        # The name of a stream, encapsulator/random_stream.py, has room for the number of a node. A path takes
        # as much as the upper half of a block's number beside it: 64 bits, so that no two paths meet.
        digest = hashlib.sha256(f"{path}\0{index}".encode()).digest()
        self._path = (int.from_bytes(digest[:4], "little"), int.from_bytes(digest[4:8], "little"))
        self._key = (seed & _MASK_32, seed >> 32 & _MASK_32)
        self._block = 0

    def _next_block(self) -> Words:
        block = philox4x32((self._block, *self._path, Purpose.PARAMETER), self._key)
        self._block += 1
        return block

    def uniform(self) -> float:
        """Uniform in [0, 1), 53 random bits."""
        return self.uniform_pair()[0]

    def uniform_pair(self) -> tuple[float, float]:
        """Two independent uniform numbers from one block."""
        words = self._next_block()
        return _uniform_of(words[0], words[1]), _uniform_of(words[2], words[3])

    def uniform_int(self, count: int) -> int:
        """Uniform in 0 … count - 1, without bias. 0 < count <= 2^64."""
        bits = (count - 1).bit_length()
        while True:
            words = self._next_block()
            number = (words[0] << 32 | words[1]) >> 64 - bits
            if number < count:
                return number

    def exponential(self) -> float:
        """Exponential with mean 1: -ln(1 - u)."""
        return -math.log(1.0 - self.uniform())

    def normal(self) -> float:
        """Standard normal: sqrt(-2 ln(1 - u)) cos(2 pi v), as in the engine's fading.

        Source: G. E. P. Box, M. E. Muller, "A note on the generation of random normal deviates", Annals of
        Mathematical Statistics 29, 1958.
        """
        u, v = self.uniform_pair()
        return math.sqrt(-2.0 * math.log(1.0 - u)) * math.cos(2.0 * math.pi * v)


def _uniform_of(high: int, low: int) -> float:
    """As RandomStream.random makes a number of two words."""
    return (high >> 5 << 26 | low >> 6) * 2.0**-53


# The distributions: each takes a stream and its values, in one unit.


def _uniform(stream: ParameterStream, low: Quantity, high: Quantity) -> float:
    """In [a, b): a + (b - a) u; a if both are equal."""
    _check_order(low, high)
    start, end = float(low.number), float(high.number)
    if not math.isfinite(end - start):
        raise BadValue(f"`{low}` and `{high}` are too far apart")
    number = start + (end - start) * stream.uniform()
    return min(number, math.nextafter(end, start))  # the sum may be rounded to the end


def _intuniform(stream: ParameterStream, low: Quantity, high: Quantity) -> int:
    """One of the integers a … b, both included."""
    _check_order(low, high)
    first, last = _integer(low), _integer(high)
    if last - first >= _MOST_INTEGERS:
        raise BadValue(f"`{low}` and `{high}` are too far apart")
    return first + stream.uniform_int(last - first + 1)


def _exponential(stream: ParameterStream, mean: Quantity) -> float:
    return _at_least_0(mean, "mean") * stream.exponential()


def _normal(stream: ParameterStream, mean: Quantity, stddev: Quantity) -> float:
    return float(mean.number) + _at_least_0(stddev, "standard deviation") * stream.normal()


def _truncnormal(stream: ParameterStream, mean: Quantity, stddev: Quantity) -> float:
    """The part of the normal distribution that is not negative: drawn again until it is."""
    if float(mean.number) < -_FARTHEST * _at_least_0(stddev, "standard deviation"):
        of_both = f"a mean of `{mean}` and a standard deviation of `{stddev}`"
        raise BadValue(f"with {of_both} not one number in a thousand is positive")
    while (number := _normal(stream, mean, stddev)) < 0:
        pass
    return number


def _lognormal(stream: ParameterStream, mean: Quantity, stddev: Quantity) -> float:
    """Exp of a normally distributed number."""
    _check_plain(mean)
    return math.exp(_normal(stream, mean, stddev))


def _triang(stream: ParameterStream, low: Quantity, peak: Quantity, high: Quantity) -> float:
    """Density that rises from a to its peak at b and falls to c, in straight lines."""
    _check_order(low, peak)
    _check_order(peak, high)
    start, middle, end = (float(value.number) for value in (low, peak, high))
    u = stream.uniform()
    if end == start:
        return start
    if u * (end - start) < middle - start:
        return start + math.sqrt(u * (end - start)) * math.sqrt(middle - start)
    return end - math.sqrt((1 - u) * (end - start)) * math.sqrt(end - middle)


def _weibull(stream: ParameterStream, scale: Quantity, shape: Quantity) -> float:
    """The number a (-ln(1 - u))^(1 / b): scale a, shape b, which as in OMNeT++ has the unit of the scale."""
    factor, exponent = _above_0(scale, "scale"), 1 / _above_0(shape, "shape")
    return factor * math.pow(stream.exponential(), exponent)


def _pareto_shifted(stream: ParameterStream, shape: Quantity, scale: Quantity, shift: Quantity) -> float:
    """The number b / (1 - u)^(1 / a) - c: shape a, scale b, shifted down by c."""
    exponent, factor = 1 / _above_0(shape, "shape"), _above_0(scale, "scale")
    return factor / math.pow(1.0 - stream.uniform(), exponent) - float(shift.number)


def _cauchy(stream: ParameterStream, median: Quantity, width: Quantity) -> float:
    """The number a + b tan(pi (u - 1/2)): median a, half width b at half of the peak."""
    half_width = _above_0(width, "width")
    return float(median.number) + half_width * math.tan(math.pi * (stream.uniform() - 0.5))


def _erlang_k(stream: ParameterStream, k: Quantity, mean: Quantity) -> float:
    """The sum of k exponentially distributed numbers, with that mean together."""
    count = _integer(k)
    if not 1 <= count <= _MOST_TO_ADD:
        raise BadValue(f"k = `{k}` is out of range", expected=f"1 to {_MOST_TO_ADD}")
    return _at_least_0(mean, "mean") / count * sum(stream.exponential() for _ in range(count))


def _bernoulli(stream: ParameterStream, p: Quantity) -> int:
    """1 with probability p, else 0."""
    return int(stream.uniform() < _probability(p))


def _geometric(stream: ParameterStream, p: Quantity) -> int:
    """How often something of probability p fails before it succeeds."""
    probability = _probability(p)
    if probability == 0:
        raise BadValue("with the probability `0` it would never end")
    return 0 if probability == 1 else math.floor(stream.exponential() / -math.log1p(-probability))


def _poisson(stream: ParameterStream, mean: Quantity) -> int:
    """How many exponentially distributed intervals of mean 1 end within the mean."""
    _check_plain(mean)
    rest = _at_least_0(mean, "mean")
    if rest > _MOST_TO_ADD:
        raise BadValue(f"the mean `{mean}` is too large", expected=f"at most {_MOST_TO_ADD}")
    count = 0
    while (rest := rest - stream.exponential()) > 0:
        count += 1
    return count


class _Distribution(NamedTuple):
    """How a distribution is written, its function, and whether its first value is a shape without a unit."""

    written: str
    draw: Callable[..., Number]
    has_shape: bool = False


DISTRIBUTIONS: dict[str, _Distribution] = {
    "uniform": _Distribution("uniform(a, b)", _uniform),
    "intuniform": _Distribution("intuniform(a, b)", _intuniform),
    "exponential": _Distribution("exponential(mean)", _exponential),
    "normal": _Distribution("normal(mean, stddev)", _normal),
    "truncnormal": _Distribution("truncnormal(mean, stddev)", _truncnormal),
    "lognormal": _Distribution("lognormal(m, w)", _lognormal),
    "triang": _Distribution("triang(a, b, c)", _triang),
    "weibull": _Distribution("weibull(a, b)", _weibull),
    "cauchy": _Distribution("cauchy(a, b)", _cauchy),
    "pareto_shifted": _Distribution("pareto_shifted(a, b, c)", _pareto_shifted, has_shape=True),
    "erlang_k": _Distribution("erlang_k(k, mean)", _erlang_k, has_shape=True),
    "bernoulli": _Distribution("bernoulli(p)", _bernoulli),
    "geometric": _Distribution("geometric(p)", _geometric),
    "poisson": _Distribution("poisson(mean)", _poisson),
}
"""By name."""

_CALL_OR_STRING = re.compile(rf"{QUOTED}|\b({'|'.join(DISTRIBUTIONS)})\s*\(", re.ASCII | re.DOTALL)


def distribution_in(text: str) -> str:
    """Return the name of the first distribution that a value calls, or "" if it draws nothing."""
    if "(" not in text:
        return ""
    return next((match[1] for match in _CALL_OR_STRING.finditer(text) if match[1]), "")


def draw(name: str, given: Sequence[Value], stream: ParameterStream) -> Quantity:
    """Draw a number of the distribution `name`, in the unit of its values.

    Raises:
        BadValue: The values do not go with the distribution or with each other.
    """
    distribution = DISTRIBUTIONS[name]
    values = [value for value in given if isinstance(value, Quantity)]
    if len(values) < len(given):
        raise BadValue(f"`{name}` takes numbers only")
    try:
        check_count(distribution.written, len(values))
    except BadValue as error:
        one_more = len(values) == distribution.written.count(",") + 2
        hint = "; generators have no numbers here, each parameter has its own" if one_more else ""
        raise BadValue(error.problem, hint) from None
    try:
        first = int(distribution.has_shape)
        for shape in values[:first]:
            _check_plain(shape)
        number = distribution.draw(stream, *_in_one_unit(values[:first]), *_in_one_unit(values[first:]))
        if not math.isfinite(number):
            raise OverflowError
    except BadValue as error:
        raise error.with_problem(f"`{name}`: {error.problem}") from None
    except (OverflowError, ZeroDivisionError):
        raise BadValue(f"`{name}`: it has drawn a number that is too large") from None
    return Quantity(number, values[first].unit)


def _in_one_unit(values: Sequence[Quantity]) -> list[Quantity]:
    """The values in the unit of the first one. BadValue if one is not finite or measures something else."""
    for value in values:
        if not math.isfinite(value.number):
            raise BadValue(f"`{value}` is not finite")
    return [value if value.unit == values[0].unit else _converted(value, values[0]) for value in values]


def _converted(value: Quantity, first: Quantity) -> Quantity:
    is_level = first.unit is not None and first.unit.logarithmic
    if first.unit is None or not value.has_dimension_of(first):
        # For `normal(10dBm, 3dB)`: what spreads a level by 3 dB is written like the level itself.
        is_ratio = value.unit is not None and value.unit.dimension is Dimension.LEVEL
        meant = str(Quantity(value.number, first.unit)) if is_level and is_ratio else ""
        raise BadValue(f"`{first}` and `{value}` measure different things", suggestion=meant)
    if is_level or (value.unit is not None and value.unit.logarithmic):
        raise BadValue(f"`{first}` and `{value}` have different units, and one is a logarithm")
    return Quantity(0, first.unit).plus(value)


def _check_order(low: Quantity, high: Quantity) -> None:
    if low.number > high.number:
        raise BadValue(f"`{low}` is more than `{high}`", "; the smaller one comes first")


def _check_plain(value: Quantity) -> None:
    if value.unit is not None:
        raise BadValue(f"`{value}` is not a plain number")


def _integer(value: Quantity) -> int:
    if isinstance(value.number, int):
        return value.number
    if isinstance(value.number, Fraction) and value.number.denominator == 1:  # of another unit, 1km in meters
        return value.number.numerator
    raise BadValue(f"`{value}` is not an integer")


def _at_least_0(value: Quantity, what: str) -> float:
    if value.number < 0:
        raise BadValue(f"the {what} `{value}` is negative")
    return float(value.number)


def _above_0(value: Quantity, what: str) -> float:
    if not value.number > 0:
        raise BadValue(f"the {what} `{value}` is not positive")
    return float(value.number)


def _probability(value: Quantity) -> float:
    if value.unit is not None or not 0 <= value.number <= 1:
        raise BadValue(f"`{value}` is not a probability", expected="0 to 1")
    return float(value.number)
