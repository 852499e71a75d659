import math

import pytest

from gradysim.simulator.validation import check_reference


@pytest.mark.parametrize("place", [(0, 0, 0), (90, -200.5, 1e3), [-90, 0, -5]])
def test_a_place_is_right(place):
    check_reference(place)


@pytest.mark.parametrize(
    "place",
    [(90.1, 0, 0), (-91, 0, 0), (0, math.inf, 0), (0, 0, math.nan), (0, 0), "abc", None, (0, 0, 0, 0)],
)
def test_anything_else_is_refused_by_value(place):
    with pytest.raises(ValueError, match=r"^reference_coordinates must be") as caught:
        check_reference(place)
    assert str(caught.value).endswith(repr(place))
