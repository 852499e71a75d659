"""Streams of parameters, and ranges, shapes and units of the distributions."""

import math
from collections.abc import Callable
from statistics import NormalDist, fmean, stdev

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.encapsulator.random_stream import Purpose, philox4x32
from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.distributions import DISTRIBUTIONS, ParameterStream, distribution_in
from gradysim.scenario.parse.expressions import ParameterContext, parse_value
from gradysim.scenario.parse.units import Quantity

PATH = "uavs[3].mobility.initialX"


def first(seed: int = 1, path: str = PATH, index: int = 0) -> float:
    return ParameterStream(seed, path, index).uniform()


def test_the_name_gives_the_numbers() -> None:
    assert first() == first()
    others = {first(), first(seed=2), first(path="uavs[4].mobility.initialX"), first(index=1)}
    assert len(others) == 4


def test_all_64_bits_of_the_seed_count() -> None:
    assert len({first(seed=1 << bit) for bit in range(64)}) == 64


def test_the_numbers_never_change() -> None:
    """They are part of every result of a file with random values."""
    stream = ParameterStream(7, PATH, 0)
    assert [stream.uniform() for _ in range(3)] == [
        0.15135179371822116,
        0.381352411892407,
        0.2969851101537849,
    ]
    assert stream.uniform_pair() == (0.007072630869297991, 0.9760583342794937)
    assert stream.uniform_int(1000) == 819


def test_a_block_is_the_generators_with_the_path_in_the_place_of_a_node() -> None:
    # The first eight bytes of SHA-256 of the path, a zero and the place.
    path = (0xDDBDFDC8, 0x778633C0)
    words = philox4x32((0, *path, Purpose.PARAMETER), (7, 0))
    assert ParameterStream(7, PATH, 0).uniform() == ((words[0] >> 5 << 26) | words[1] >> 6) * 2.0**-53


def test_the_two_of_a_pair_are_different_and_each_block_is_another() -> None:
    stream = ParameterStream(1, PATH, 0)
    numbers = [number for _ in range(50) for number in stream.uniform_pair()]
    assert len(set(numbers)) == 100


def test_whole_numbers_are_below_the_count_and_equally_frequent() -> None:
    stream = ParameterStream(1, PATH, 0)
    counts = [0] * 5
    for _ in range(5000):
        counts[stream.uniform_int(5)] += 1
    chi_square = sum((count - 1000) ** 2 / 1000 for count in counts)
    assert chi_square < 13.28  # 99 % of 4 degrees of freedom; the seed is fixed


def test_one_whole_number_is_0_and_the_largest_count_is_understood() -> None:
    stream = ParameterStream(1, PATH, 0)
    assert stream.uniform_int(1) == 0
    assert any(stream.uniform_int(2**64) >= 2**63 for _ in range(20))


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
    """Return one number for each of many nodes."""
    return [float(drawn(text, path=f"nodes[{index}].protocol.start").number) for index in range(COUNT)]


def distance(text: str, distribution: Callable[[float], float]) -> float:
    """Return the largest distance between the distribution functions of the sample and of the model."""
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
    "text",
    [
        "uniform(1m)",
        "uniform()",
        "exponential(1s, 2s, 3s)",
        "uniform(0m, 1s)",
        "uniform(0, 1s)",
        "normal(0m, 1s)",
        "normal(0m, 1dB)",
        "uniform(1mW, 20dBm)",
        "uniform(0, inf)",
        "uniform(nan, 0)",
        "uniform(-1.7e308, 1.7e308)",
        "intuniform(1.5, 2)",
        "intuniform(1m, 1500mm)",
        "intuniform(0, 18446744073709551616)",
        "exponential(-1s)",
        "normal(1s, -1s)",
        "truncnormal(1s, -1s)",
        "truncnormal(-4s, 1s)",
        "lognormal(1s, 1s)",
        "lognormal(1000, 1)",
        "pareto_shifted(1e-6, 2s, 1s)",
        "pareto_shifted(inf, 2s, 1s)",
        "weibull(0s, 1s)",
        "weibull(1, 0)",
        "weibull(2s, 3)",
        "cauchy(1s, 0s)",
        "pareto_shifted(3s, 2s, 1s)",
        "pareto_shifted(0, 2s, 1s)",
        "pareto_shifted(3, 2s, 1)",
        "erlang_k(0, 1s)",
        "erlang_k(1.5, 1s)",
        "bernoulli(1.1)",
        "geometric(0)",
        "poisson(-1)",
        "poisson(1s)",
        "poisson(10001)",
        'uniform("a", 1)',
        "uniform(1, true)",
        "uniform(1, 2",
        "uniform(1, 2) 3",
        "uniform(" * 60,
    ],
)
def test_wrong_draws_are_refused(text: str) -> None:
    with pytest.raises(BadValue) as error:
        drawn(text)
    assert error.value.suggestion == error.value.hint == ""


@pytest.mark.parametrize(
    ("text", "suggestion"),
    [
        ("unifrom(0m, 1m)", "uniform"),
        ("exponential(1s, 2)", "; generators have no numbers here, each parameter has its own"),
        ("normal(10dBm, 3dB)", "3dBm"),
        ("uniform(2m, 1m)", "; the smaller one comes first"),
        ("uniform(2m, 1mm)", "; the smaller one comes first"),
        ("intuniform(2, 1)", "; the smaller one comes first"),
        ("triang(2, 1, 3)", "; the smaller one comes first"),
        ("triang(1, 3, 2)", "; the smaller one comes first"),
    ],
)
def test_wrong_draws_get_suggestions(text: str, suggestion: str) -> None:
    with pytest.raises(BadValue) as error:
        drawn(text)
    assert (error.value.suggestion or error.value.hint) == suggestion


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
    assert distribution_in(text) == name


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_every_call_is_found(name: str) -> None:
    assert distribution_in(f"1m + {name}(1m)") == name
