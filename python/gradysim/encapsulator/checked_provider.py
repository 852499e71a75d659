"""A provider whose tracked variables are some, whatever a protocol assigns."""

from typing import Any

from gradysim.encapsulator.tracked_variables import check_variables
from gradysim.protocol.interface import IProvider


class CheckedProvider(IProvider):
    """Refuses `tracked_variables = None` in the callback that says it: no result could be made of it."""

    def __setattr__(self, name: str, value: Any) -> None:
        # Not a property: each access would cost more.
        if name == "tracked_variables":
            check_variables(value)
        super().__setattr__(name, value)
