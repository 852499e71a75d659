import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.value.decibels import db_from_ratio, dbm_from_w, ratio_from_db


@pytest.mark.parametrize(("ratio", "ratio_db"), [(1, 0), (10, 10), (0.01, -20)])
def test_tenfold_is_10_db(ratio: float, ratio_db: float) -> None:
    assert (db_from_ratio(ratio), ratio_from_db(ratio_db)) == (ratio_db, ratio)


def test_1_mw_is_0_dbm() -> None:
    assert (dbm_from_w(1e-3), dbm_from_w(1)) == (0, 30)


def test_nothing_is_minus_infinity() -> None:
    assert (db_from_ratio(0), dbm_from_w(0)) == (-math.inf, -math.inf)


@given(st.floats(-300, 300))
def test_there_and_back(ratio_db: float) -> None:
    assert db_from_ratio(ratio_from_db(ratio_db)) == pytest.approx(ratio_db, abs=1e-12)
