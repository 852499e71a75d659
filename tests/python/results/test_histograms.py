import itertools

import pytest

from gradysim.results.delays import constant_delays
from gradysim.results.histograms import histograms, rows_of_bins
from gradysim.results.run_result import RunResult

DELAYS = constant_delays({0.5: 2})
RESULT = RunResult(
    *("A", 3, 3, "integrated", 1.5, 0.25, 0.125, 10, False, None, {}, ()),
    message_delays={"broadcast": DELAYS},
)


def test_of_each_kind_of_messages():
    (histogram,) = histograms(RESULT, "Field")
    assert (histogram.module, histogram.name) == ("Field", "broadcastMessage:delay:histogram")
    assert histogram.values is DELAYS
    assert histogram.attributes["unit"] == "s"


@pytest.mark.parametrize("counts", [{0.0: 1}, {0.5: 2, 0.5000001: 7, 3.0: 1}])
def test_edges_are_strictly_increasing_and_all_values_are_between_them(counts):
    edges, found = zip(*rows_of_bins(constant_delays(counts)), strict=True)
    assert all(one < other for one, other in itertools.pairwise(edges))
    assert (found[0], found[-1]) == (0, 0)
    assert sum(found) == sum(counts.values())
