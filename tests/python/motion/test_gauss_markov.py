"""Random errors that change slowly."""

import math
from collections.abc import Callable

import pytest

from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.motion.gauss_markov import GaussMarkov


@pytest.fixture
def process() -> Callable[..., GaussMarkov]:
    """`process(seed=1)`: deviations 1, 2, 3; correlation time 5 s; drawn every 0.5 s."""

    def make(seed: int = 1) -> GaussMarkov:
        return GaussMarkov(RandomStream(seed, 0, Purpose.GUSTS), (1.0, 2.0, 3.0), 5.0, 0.5)

    return make


def test_it_has_its_deviations_and_its_correlation(process: Callable[..., GaussMarkov]) -> None:
    drawn = process()
    values = [drawn.at(0.5 * number) for number in range(20_000)]
    for axis, deviation in enumerate((1, 2, 3)):
        of_axis = [value[axis] for value in values]
        variance = sum(value * value for value in of_axis) / len(of_axis)
        assert math.sqrt(variance) == pytest.approx(deviation, rel=0.05)
        lagged = sum(one * other for one, other in zip(of_axis, of_axis[10:], strict=False))
        assert lagged / len(of_axis) / variance == pytest.approx(math.exp(-1), abs=0.08)


def test_it_is_linear_between_two_draws(process: Callable[..., GaussMarkov]) -> None:
    drawn = process()
    before, between, after = (drawn.at(time_s) for time_s in (0.5, 0.625, 1.0))
    for one, middle, other in zip(before, between, after, strict=True):
        assert middle == pytest.approx(one + (other - one) / 4)


def test_it_does_not_depend_on_the_times_of_calls(process: Callable[..., GaussMarkov]) -> None:
    often = process()
    for number in range(100):
        often.at(0.1 * number)
    assert often.at(10.0) == process().at(10.0) != process(2).at(10.0)
