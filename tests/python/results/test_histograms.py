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
    assert histogram.attributes == {
        "unit": "s",
        "source": "broadcastMessage:delay",
        "recordingmode": "histogram",
    }


def test_a_bin_of_a_single_value_is_wide_enough_for_a_density():
    edges, found = zip(*rows_of_bins(constant_delays({0.0: 3})), strict=True)
    assert found[1] / (edges[2] - edges[1]) == pytest.approx(3e12)


@pytest.mark.parametrize(
    "counts", [{0.0: 1}, {0.5: 2, 0.5000001: 7, 3.0: 1}, {0.5: 1, 0.5 + 1e-13: 2, 0.5 + 2e-13: 1, 5e5: 1}]
)
def test_edges_are_strictly_increasing_and_all_values_are_between_them(counts):
    edges, found = zip(*rows_of_bins(constant_delays(counts)), strict=True)
    assert all(one < other for one, other in itertools.pairwise(edges))
    assert (found[0], found[-1]) == (0, 0)
    assert sum(found) == sum(counts.values())
