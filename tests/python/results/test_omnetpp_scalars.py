import math

import pytest

from gradysim.results.delays import Delays, Histogram, constant_delays
from gradysim.results.omnetpp import RunIdentity, write_scalar_file
from gradysim.results.quantity import Scalar
from python.sqlite_rows import rows_of

IDENTITY = RunIdentity("A-0-20261123-05:00:00-7", {}, {}, ())


@pytest.fixture
def rows(tmp_path):
    """`rows(scalars, query, histograms)`: rows of a file with this content."""

    def of(scalars, query, histograms=()):
        path = tmp_path / "A.sca"
        write_scalar_file(scalars, IDENTITY, path, histograms)
        return rows_of(path, query)

    return of


def test_a_row_for_each_scalar(rows):
    found = rows([Scalar("N.a[0]", "x:last", 5), Scalar("N.a[1]", "x:last", 0.5)], "SELECT * FROM scalar")
    assert found == [(1, 1, "N.a[0]", "x:last", 5.0), (2, 1, "N.a[1]", "x:last", 0.5)]


def test_nan_is_null_and_infinity_is_itself(rows):
    found = rows([Scalar("N", "x", math.nan), Scalar("N", "y", -math.inf)], "SELECT scalarValue FROM scalar")
    assert found == [(None,), (-math.inf,)]


def test_a_histogram_with_its_statistics(rows):
    histogram = Histogram("N", "x:histogram", constant_delays({0.5: 3, 1.5: 1}), {"unit": "s"})
    (row,) = rows([], "SELECT * FROM statistic", [histogram])
    assert row[:11] == (1, 1, "N", "x:histogram", 1, 0, 4, 0.75, 0.5, 3.0, 3.0)
    assert row[11:] == (0.5, 1.5, None, None, None, None)
    assert rows([], "SELECT * FROM statisticAttr", [histogram]) == [(1, "unit", "s")]


def test_edges_of_bins_go_up_from_what_is_below_to_what_is_above_them(rows):
    values = Delays(5, 9.0, 20.0, 1.0, 4.0, ((1.0, 2.0, 3), (2.0, 3.0, 1), (3.5, 4.0, 1)))
    found = rows([], "SELECT * FROM histogramBin", [Histogram("N", "x", values)])
    edges = [(-math.inf, 0), (1.0, 3), (2.0, 1), (3.0, 0), (3.5, 1), (4.0, 0)]
    assert found == [(1, *edge) for edge in edges]


def test_a_single_value_has_no_deviation(rows):
    query = "SELECT statStddev FROM statistic"
    assert rows([], query, [Histogram("N", "x", constant_delays({0.5: 1}))]) == [(None,)]


def test_attributes_are_those_of_their_scalar(rows):
    found = rows([Scalar("N", "x", 1), Scalar("N", "y", 2, {"unit": "s"})], "SELECT * FROM scalarAttr")
    assert found == [(2, "unit", "s")]
