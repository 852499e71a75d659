"""What is worked out from a class once, and kept as long as the class.

`functools.lru_cache` would keep the class, and with it the module of a protocol and all that lies in it: a
script that reads files again and again, each time as modules of their own, would have them all in memory.
"""

from collections.abc import Callable
from functools import wraps
from typing import TypeVar
from weakref import WeakKeyDictionary

_Class = TypeVar("_Class", bound=type)
_Value = TypeVar("_Value")


def kept_with_class(work_out: Callable[[_Class], _Value]) -> Callable[[_Class], _Value]:
    """Decorates a function of one class. What it returns must not refer to the class."""
    known: WeakKeyDictionary[_Class, _Value] = WeakKeyDictionary()

    @wraps(work_out)
    def kept(cls: _Class) -> _Value:
        if cls not in known:
            known[cls] = work_out(cls)
        return known[cls]

    return kept
