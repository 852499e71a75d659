import math

import pytest

from gradysim.results.run_identity import RunIdentity
from gradysim.results.scalar_file import write_scalar_file
from gradysim.results.scalars import Scalar
from python.sqlite_rows import rows_of

IDENTITY = RunIdentity("A-0-20261123-05:00:00-7", {}, {}, ())


@pytest.fixture
def rows(tmp_path):
    """`rows(scalars, query)`: of a file that has these scalars."""

    def of(scalars, query):
        path = tmp_path / "A.sca"
        write_scalar_file(scalars, IDENTITY, path)
        return rows_of(path, query)

    return of


def test_a_row_for_each_scalar(rows):
    found = rows([Scalar("N.a[0]", "x:last", 5), Scalar("N.a[1]", "x:last", 0.5)], "SELECT * FROM scalar")
    assert found == [(1, 1, "N.a[0]", "x:last", 5.0), (2, 1, "N.a[1]", "x:last", 0.5)]


def test_nan_is_null_and_infinity_is_itself(rows):
    found = rows([Scalar("N", "x", math.nan), Scalar("N", "y", -math.inf)], "SELECT scalarValue FROM scalar")
    assert found == [(None,), (-math.inf,)]


def test_attributes_are_those_of_their_scalar(rows):
    found = rows([Scalar("N", "x", 1), Scalar("N", "y", 2, {"unit": "s"})], "SELECT * FROM scalarAttr")
    assert found == [(2, "unit", "s")]
