import itertools
import math
from statistics import fmean, stdev

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.results.delays import Delays, bin_rows, constant_delays, delay_histograms

times_s = st.integers(0, 10**18).map(lambda picoseconds: picoseconds / 1e12)


def one_by_one(delays_s):
    return constant_delays({delay_s: delays_s.count(delay_s) for delay_s in delays_s})


@given(st.lists(times_s, min_size=2, max_size=20))
def test_moments_are_those_of_the_single_delays(delays_s):
    delays = one_by_one(delays_s)
    assert (delays.count, delays.min_s, delays.max_s) == (len(delays_s), min(delays_s), max(delays_s))
    assert delays.mean_s == pytest.approx(fmean(delays_s))
    assert delays.stddev_s == pytest.approx(stdev(delays_s), rel=1e-6, abs=1e-6 * max(delays_s))


def test_a_single_delay_does_not_vary():
    assert constant_delays({0.3: 1}).stddev_s == 0


@given(times_s, st.integers(2, 10**6))
def test_equal_delays_do_not_vary(delay_s, count):
    delays = constant_delays({delay_s: count})
    assert (delays.mean_s, delays.stddev_s) == (delay_s, 0)


def test_quantiles_of_constant_delays_are_exact():
    delays = constant_delays({0.1: 9, 2.0: 1})
    assert [delays.quantile_s(share) for share in (0, 0.5, 0.9, 1)] == pytest.approx([0.1, 0.1, 0.1, 2])


def test_delays_that_nobody_met_do_not_count():
    assert constant_delays({0.1: 2, 7.0: 0}).max_s == 0.1


@given(st.lists(times_s, min_size=1, max_size=20), st.floats(0, 1))
def test_a_quantile_is_not_exceeded_by_its_share(delays_s, share):
    quantile_s = one_by_one(delays_s).quantile_s(share)
    assert min(delays_s) <= quantile_s <= max(delays_s)
    assert sum(delay_s <= math.nextafter(quantile_s, math.inf) for delay_s in delays_s) >= share * len(
        delays_s
    )


def test_within_a_bin_delays_lie_evenly():
    delays = Delays(4, 6.0, 10.0, 1.0, 2.0, ((1.0, 2.0, 4),))
    assert [delays.quantile_s(share) for share in (0, 0.25, 1)] == [1, 1.25, 2]


def test_no_quantile_lies_beyond_what_was_met():
    delays = Delays(2, 2.6, 3.4, 1.2, 1.4, ((1.0, 2.0, 2),))
    assert (delays.quantile_s(0), delays.quantile_s(1)) == (1.2, 1.4)


def test_what_results_tell():
    assert constant_delays({0.5: 2}).to_json_object() == {
        "count": 2,
        "mean_s": 0.5,
        "stddev_s": 0,
        "min_s": 0.5,
        "quantiles_s": dict.fromkeys(("0.5", "0.9", "0.95", "0.99"), 0.5),
        "max_s": 0.5,
        "cumulative": {"time_s": [0.5], "share": [1]},
    }


def test_shares_are_those_of_the_upper_ends_of_bins():
    delays = Delays(4, 6.0, 10.0, 1.0, 2.5, ((1.0, 1.5, 1), (2.0, 3.0, 3)))
    assert delays.to_json_object()["cumulative"] == {"time_s": [1.5, 2.5], "share": [0.25, 1]}


def test_a_histogram_for_each_kind_of_message():
    delays = constant_delays({0.5: 2})
    (histogram,) = delay_histograms({"broadcast": delays}, "Field")
    assert (histogram.module, histogram.name) == ("Field", "broadcastMessage:delay:histogram")
    assert histogram.values is delays
    assert histogram.attributes == {
        "unit": "s",
        "source": "broadcastMessage:delay",
        "recordingmode": "histogram",
    }


def test_a_bin_of_a_single_value_is_wide_enough_for_a_density():
    edges, found = zip(*bin_rows(constant_delays({0.0: 3})), strict=True)
    assert found[1] / (edges[2] - edges[1]) == pytest.approx(3e12)


@pytest.mark.parametrize(
    "counts", [{0.0: 1}, {0.5: 2, 0.5000001: 7, 3.0: 1}, {0.5: 1, 0.5 + 1e-13: 2, 0.5 + 2e-13: 1, 5e5: 1}]
)
def test_edges_are_strictly_increasing_and_all_values_are_between_them(counts):
    edges, found = zip(*bin_rows(constant_delays(counts)), strict=True)
    assert all(one < other for one, other in itertools.pairwise(edges))
    assert (found[0], found[-1]) == (0, 0)
    assert sum(found) == sum(counts.values())
