from typing import Any

import pytest

from gradysim.protocol.errors import CommunicationException
from gradysim.protocol.messages.interface_index import MOST_INTERFACES, checked_interface


@pytest.mark.parametrize("index", [0, 1, MOST_INTERFACES - 1])
def test_an_index_that_a_node_may_have_is_returned(index: int) -> None:
    assert checked_interface(index) == index


@pytest.mark.parametrize("value", [-1, MOST_INTERFACES, 2**70, True, False, 1.0, "two", None, [1]])
def test_anything_else_is_refused_as_it_was_given(value: Any) -> None:
    with pytest.raises(CommunicationException) as error:
        checked_interface(value)
    assert str(error.value) == f"interface must be an int from 0 to 15, such as 1 for wlan[1], got {value!r}"
