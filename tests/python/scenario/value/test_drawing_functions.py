"""Functions that draw: ranges and shapes of the distributions, units, and what is refused."""

import math
import re
from collections.abc import Callable
from statistics import NormalDist, fmean, stdev

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.drawing_functions import DRAWING_FUNCTIONS, drawing_function_in
from gradysim.scenario.value.expression import parse_value
from gradysim.scenario.value.parameter_context import ParameterContext
from gradysim.scenario.value.quantity import Quantity

COUNT = 4000
KOLMOGOROV_99 = 1.63 / math.sqrt(COUNT)
"""The largest distance of two distribution functions in 99 of 100 samples; the seeds are fixed."""

numbers = st.floats(-1e6, 1e6)
seeds = st.integers(0, 2**63 - 1)


def drawn(text: str, seed: int = 1, path: str = "nodes[0].protocol.start") -> Quantity:
    value = parse_value(text, ParameterContext(seed, path))
    assert isinstance(value, Quantity)
    return value


def sample(text: str) -> list[float]:
    """One number of each of many nodes."""
    return [float(drawn(text, path=f"nodes[{index}].protocol.start").number) for index in range(COUNT)]


def distance(text: str, distribution: Callable[[float], float]) -> float:
    """The largest distance between the distribution function of the sample and the one it should have."""
    values = sorted(sample(text))
    return max(
        max(abs(distribution(value) - index / COUNT), abs(distribution(value) - (index + 1) / COUNT))
        for index, value in enumerate(values)
    )


@given(numbers, numbers, seeds)
def test_uniform_is_in_its_range(one: float, other: float, seed: int) -> None:
    low, high = min(one, other), max(one, other)
    number = drawn(f"uniform({low!r}, {high!r})", seed).number
    assert low <= number < high or low == number == high


def test_uniform_between_neighbours_is_the_lower_one() -> None:
    high = math.nextafter(1.0, 2.0)
    assert {drawn(f"uniform(1, {high!r})", seed).number for seed in range(20)} == {1.0}


@given(st.integers(-(10**9), 10**9), st.integers(0, 10**9), seeds)
def test_intuniform_is_a_whole_number_in_its_range(low: int, width: int, seed: int) -> None:
    number = drawn(f"intuniform({low}, {low + width})", seed).number
    assert isinstance(number, int)
    assert low <= number <= low + width


def test_intuniform_draws_both_ends() -> None:
    assert set(sample("intuniform(1, 6)")) == {1, 2, 3, 4, 5, 6}


@given(st.floats(0, 1e6), seeds)
def test_exponential_is_not_negative(mean: float, seed: int) -> None:
    assert 0 <= drawn(f"exponential({mean!r})", seed).number < math.inf


@given(st.floats(-3, 1000), st.floats(0.001, 1), seeds)
def test_truncnormal_is_not_negative(mean_in_deviations: float, deviation: float, seed: int) -> None:
    mean = mean_in_deviations * deviation * 0.99
    assert drawn(f"truncnormal({mean!r}, {deviation!r})", seed).number >= 0


@pytest.mark.parametrize(
    ("text", "distribution"),
    [
        ("uniform(2s, 4s)", lambda x: (x - 2) / 2),
        ("exponential(3s)", lambda x: 1 - math.exp(-x / 3)),
        ("normal(5s, 2s)", NormalDist(5, 2).cdf),
        (
            "truncnormal(1s, 2s)",
            lambda x: (NormalDist(1, 2).cdf(x) - NormalDist(1, 2).cdf(0)) / (1 - NormalDist(1, 2).cdf(0)),
        ),
        ("lognormal(1, 0.5)", lambda x: NormalDist(1, 0.5).cdf(math.log(x))),
        ("triang(1s, 2s, 4s)", lambda x: (x - 1) ** 2 / 3 if x < 2 else 1 - (4 - x) ** 2 / 6),
        ("weibull(2s, 3s)", lambda x: 1 - math.exp(-((x / 2) ** 3))),
        ("cauchy(1s, 2s)", lambda x: 0.5 + math.atan((x - 1) / 2) / math.pi),
        ("pareto_shifted(3, 2s, 1s)", lambda x: 1 - (2 / (x + 1)) ** 3),
        (
            "erlang_k(3, 6s)",
            lambda x: 1 - math.exp(-x / 2) * sum((x / 2) ** n / math.factorial(n) for n in range(3)),
        ),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_distributions(text: str, distribution: Callable[[float], float]) -> None:
    assert distance(text, distribution) < KOLMOGOROV_99


@pytest.mark.parametrize(
    ("text", "probability"),
    [
        ("bernoulli(0.3)", lambda k: (0.7, 0.3)[k] if k < 2 else 0),
        ("geometric(0.3)", lambda k: 0.3 * 0.7**k),
        ("poisson(3.5)", lambda k: math.exp(-3.5) * 3.5**k / math.factorial(k)),
    ],
    ids=["bernoulli", "geometric", "poisson"],
)
def test_whole_numbers(text: str, probability: Callable[[int], float]) -> None:
    values = sample(text)
    for k in range(9):
        expected = probability(k)
        deviation = math.sqrt(expected * (1 - expected) / COUNT)
        assert values.count(k) / COUNT == pytest.approx(expected, abs=3.3 * deviation)


def test_mean_and_deviation_of_normal() -> None:
    values = sample("normal(-5, 2)")
    assert fmean(values) == pytest.approx(-5, abs=2.6 * 2 / math.sqrt(COUNT))
    assert stdev(values) == pytest.approx(2, rel=2.6 / math.sqrt(2 * COUNT))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("uniform(3s, 3s)", 3),
        ("intuniform(-2, -2)", -2),
        ("exponential(0s)", 0),
        ("normal(4s, 0s)", 4),
        ("truncnormal(4s, 0s)", 4),
        ("triang(4s, 4s, 4s)", 4),
        ("erlang_k(2, 0s)", 0),
        ("bernoulli(1) + bernoulli(0)", 1),
        ("geometric(1)", 0),
        ("poisson(0)", 0),
        ("lognormal(0, 0)", 1),
        ("2 * uniform(1s, 1s) + 1s", 3),
        ("uniform(uniform(2, 2), intuniform(2, 2))", 2),
        ("intuniform(5m, 5m) / 1m", 5),
        ("uniform((1 + 2) * 3, 9)", 9),
        ("uniform(1h 5min, 1h 5min) / 1min", 65),
        ("-intuniform(2, 2) ^ 2", 4),
    ],
)
def test_calls_are_values_like_others(text: str, expected: float) -> None:
    assert float(drawn(text).number) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "unit", "low", "high"),
    [
        ("uniform(900m, 1km)", "m", 900, 1000),
        ("uniform(0.9km, 1000m)", "km", 0.9, 1),
        ("intuniform(1m, 1km)", "m", 1, 1000),
        ("uniform(-90dBm, -80dBm)", "dBm", -90, -80),
        ("uniform(1dB, 2dB)", "dB", 1, 2),
        ("uniform(1, 2)", None, 1, 2),
    ],
)
def test_the_number_is_in_the_unit_of_the_first_value(
    text: str, unit: str | None, low: float, high: float
) -> None:
    value = drawn(text)
    assert (value.unit.name if value.unit else None) == unit
    assert low <= value.number <= high


def test_triang_spans_what_a_number_can() -> None:
    assert 0 <= drawn("triang(0, 1e200, 2e200)").number <= 2e200


def test_a_refused_draw_says_what_was_expected() -> None:
    with pytest.raises(BadValue) as caught:
        drawn("bernoulli(1.1)")
    assert caught.value.expected == "0 to 1"


def test_each_draw_in_a_value_is_another_one() -> None:
    assert drawn("uniform(0, 1) - uniform(0, 1)").number != 0


def test_spaces_and_constants_change_no_draw() -> None:
    assert drawn("1 +uniform( 0,1 )").number == 1 + float(drawn("uniform(0, 1)").number)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "unifrom(0m, 1m)",
            "there is no function `unifrom`; did you mean `uniform`?",
        ),
        ("uniform(1m)", "`uniform(a, b)` takes 2 values, not 1"),
        ("uniform()", "`uniform(a, b)` takes 2 values, not 0"),
        ("exponential(1s, 2s, 3s)", "`exponential(mean)` takes 1 value, not 3"),
        (
            "exponential(1s, 2)",
            "`exponential(mean)` takes 1 value, not 2; generators have no numbers here, each parameter has"
            " its own",
        ),
        ("uniform(0m, 1s)", "`uniform`: `0m` and `1s` measure different things"),
        ("uniform(0, 1s)", "`uniform`: `0` and `1s` measure different things"),
        ("normal(0m, 1s)", "`normal`: `0m` and `1s` measure different things"),
        ("normal(0m, 1dB)", "`normal`: `0m` and `1dB` measure different things"),
        (
            "normal(10dBm, 3dB)",
            "`normal`: `10dBm` and `3dB` measure different things; did you mean `3dBm`?",
        ),
        (
            "uniform(1mW, 20dBm)",
            "`uniform`: `1mW` and `20dBm` have different units, and one is a logarithm",
        ),
        ("uniform(2m, 1m)", "`uniform`: `2m` is more than `1m`; the smaller one comes first"),
        ("uniform(2m, 1mm)", "`uniform`: `2m` is more than `0.001m`; the smaller one comes first"),
        ("uniform(0, inf)", "`uniform`: `inf` is not finite"),
        ("uniform(nan, 0)", "`uniform`: `nan` is not finite"),
        ("uniform(-1.7e308, 1.7e308)", "`uniform`: `-1.7e+308` and `1.7e+308` are too far apart"),
        ("intuniform(2, 1)", "`intuniform`: `2` is more than `1`; the smaller one comes first"),
        ("intuniform(1.5, 2)", "`intuniform`: `1.5` is no whole number"),
        ("intuniform(1m, 1500mm)", "`intuniform`: `1.5m` is no whole number"),
        (
            "intuniform(0, 18446744073709551616)",
            "`intuniform`: `0` and `18446744073709551616` are too far apart",
        ),
        ("exponential(-1s)", "`exponential`: the mean `-1s` is negative"),
        ("normal(1s, -1s)", "`normal`: the standard deviation `-1s` is negative"),
        ("truncnormal(1s, -1s)", "`truncnormal`: the standard deviation `-1s` is negative"),
        (
            "truncnormal(-4s, 1s)",
            "`truncnormal`: with a mean of `-4s` and a standard deviation of `1s` not one number in a"
            " thousand is positive",
        ),
        ("lognormal(1s, 1s)", "`lognormal`: `1s` is no plain number"),
        ("lognormal(1000, 1)", "`lognormal`: it has drawn a number that is too large"),
        ("pareto_shifted(1e-6, 2s, 1s)", "`pareto_shifted`: it has drawn a number that is too large"),
        ("pareto_shifted(inf, 2s, 1s)", "`pareto_shifted`: `inf` is not finite"),
        ("triang(2, 1, 3)", "`triang`: `2` is more than `1`; the smaller one comes first"),
        ("triang(1, 3, 2)", "`triang`: `3` is more than `2`; the smaller one comes first"),
        ("weibull(0s, 1s)", "`weibull`: the scale `0s` is not positive"),
        ("weibull(1, 0)", "`weibull`: the shape `0` is not positive"),
        ("weibull(2s, 3)", "`weibull`: `2s` and `3` measure different things"),
        ("cauchy(1s, 0s)", "`cauchy`: the width `0s` is not positive"),
        ("pareto_shifted(3s, 2s, 1s)", "`pareto_shifted`: `3s` is no plain number"),
        ("pareto_shifted(0, 2s, 1s)", "`pareto_shifted`: the shape `0` is not positive"),
        ("pareto_shifted(3, 2s, 1)", "`pareto_shifted`: `2s` and `1` measure different things"),
        ("erlang_k(0, 1s)", "`erlang_k`: k = `0` is out of range"),
        ("erlang_k(1.5, 1s)", "`erlang_k`: `1.5` is no whole number"),
        ("bernoulli(1.1)", "`bernoulli`: `1.1` is no probability"),
        ("geometric(0)", "`geometric`: with the probability `0` it would never end"),
        ("poisson(-1)", "`poisson`: the mean `-1` is negative"),
        ("poisson(1s)", "`poisson`: `1s` is no plain number"),
        ("poisson(10001)", "`poisson`: the mean `10001` is too large"),
        ('uniform("a", 1)', "`uniform` takes numbers only"),
        ("uniform(1, true)", "`uniform` takes numbers only"),
        ("uniform(1, 2", "`(` is not closed"),
        ("uniform(1, 2) 3", "`3` is not understood there"),
        ("uniform(" * 60, "the expression is nested too deeply; expected at most 50 levels"),
    ],
)
def test_refused(text: str, message: str) -> None:
    with pytest.raises(BadValue, match=f"^{re.escape(message)}$"):
        drawn(text)


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("5m", ""),
        ("uniform(0m, 1m)", "uniform"),
        ("2 * intuniform (1, 2)", "intuniform"),
        ("uniform", ""),
        ('"uniform(0m, 1m)"', ""),
        (r'"\"uniform(0m, 1m)"', ""),
        ('"a" + normal(1, 2)', "normal"),
        ("abnormal(1, 2)", ""),
    ],
)
def test_finds_calls_outside_of_texts(text: str, name: str) -> None:
    assert drawing_function_in(text) == name


@pytest.mark.parametrize("name", DRAWING_FUNCTIONS)
def test_every_call_is_found(name: str) -> None:
    assert drawing_function_in(f"1m + {name}(1m)") == name
