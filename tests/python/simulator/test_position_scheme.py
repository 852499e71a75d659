import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.simulator.position_scheme import PositionScheme

ranges = st.tuples(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6)).map(lambda pair: (min(pair), max(pair)))


@given(ranges, ranges, ranges)
def test_points_lie_in_the_box(x_range, y_range, z_range):
    position = PositionScheme.random(x_range, y_range, z_range)
    assert all(
        low <= coordinate <= high
        for coordinate, (low, high) in zip(position, (x_range, y_range, z_range), strict=True)
    )


def test_the_default_box():
    x, y, z = PositionScheme.random()
    assert -10 <= x <= 10
    assert -10 <= y <= 10
    assert 0 <= z <= 10


@pytest.mark.parametrize("wrong", [(5, -5), 5, (1, 2, 3), (0, float("nan")), ("a", "b"), None])
def test_what_is_no_range_is_refused(wrong):
    with pytest.raises(ValueError, match="y_range"):
        PositionScheme.random(y_range=wrong)
