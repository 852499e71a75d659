from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from gradysim.protocol.errors import CommunicationException
from gradysim.protocol.messages.destination_id import checked_destination


@pytest.mark.parametrize("value", [1, True, 1.0, np.int64(1), np.float32(1), Decimal(1), Fraction(1)])
def test_what_equals_an_id_is_that_id(value: Any) -> None:
    assert {1: "found"}.get(value) == "found"
    assert type(checked_destination(value)) is int
    assert checked_destination(value) == 1


@pytest.mark.parametrize(
    "value",
    [-1, 2**31, 2**70, 1.5, float("nan"), float("inf"), "1", b"1", None, [1], np.array([1]), np.array(1)],
    ids=repr,
)
def test_anything_else_is_refused_as_it_was_given(value: Any) -> None:
    with pytest.raises(CommunicationException) as error:
        checked_destination(value)
    assert str(error.value) == f"destination must be an int, the id of a node, got {value!r}"
