"""Processing times of computers; what waits for them is in tests/python/conformance/test_computers.py."""

import math
import statistics

from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.simulator.event import time_after
from gradysim.simulator.handler.computer import ProcessingTime


def test_times_are_the_median_without_a_spread() -> None:
    stream = RandomStream(1, 0, Purpose.PROCESSING)
    assert {ProcessingTime(4e-4).draw_s(stream) for _ in range(3)} == {4e-4}


def test_times_are_log_normal() -> None:
    stream = RandomStream(1, 0, Purpose.PROCESSING)
    logarithms = [math.log(ProcessingTime(4e-4, 1.5).draw_s(stream) / 4e-4) for _ in range(20_000)]
    assert abs(statistics.fmean(logarithms)) < 0.04
    assert abs(statistics.stdev(logarithms) - 1.5) < 0.03


def test_a_later_time_is_the_one_that_is_written() -> None:
    assert 0.3 + 0.35 != 0.65
    assert time_after(0.3, 0.35) == 0.65
    assert time_after(0.1 + 0.2, 0) == 0.1 + 0.2  # not in the past
