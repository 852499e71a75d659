import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.simulator.simulation import PositionScheme

ranges = st.tuples(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6)).map(lambda pair: (min(pair), max(pair)))


@given(ranges, ranges, ranges)
def test_points_lie_in_the_box(x_range, y_range, z_range):
    position = PositionScheme.random(x_range, y_range, z_range)
    assert all(
        low <= coordinate <= high
        for coordinate, (low, high) in zip(position, (x_range, y_range, z_range), strict=True)
    )


@pytest.mark.parametrize(("share", "corner"), [(0, (-10, -10, 0)), (1, (10, 10, 10))])
def test_the_corners_of_the_default_box(monkeypatch, share, corner):
    monkeypatch.setattr("random.uniform", lambda low, high: low + share * (high - low))
    assert PositionScheme.random() == corner


@pytest.mark.parametrize("wrong", [(5, -5), 5, (1, 2, 3), (0, float("nan")), ("a", "b"), None])
def test_what_is_no_range_is_refused(wrong):
    with pytest.raises(ValueError, match="y_range"):
        PositionScheme.random(y_range=wrong)
