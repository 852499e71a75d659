"""Any Python value as one that JSON can hold.

Used for tracked variables, which protocols may fill with whatever they like.
"""

import math
from collections.abc import Mapping
from numbers import Integral, Real
from typing import Any


def plain_value(value: object) -> object:
    """Return `value` as None, bool, int, finite float, str, list or dict with text keys, all the way down.

    Numbers and arrays of numpy become Python's, tuples become lists, keys become text. NaN, which stands for
    no number, becomes None. What JSON has no form for, such as a set, an object of a user's class, an
    infinity, or a container inside itself, is given as its `repr`. Never raises.
    """
    return _plain(value, ())


def _plain(value: Any, containers: tuple[int, ...]) -> object:
    if type(value).__module__ == "numpy" and hasattr(value, "tolist"):
        value = value.tolist()
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, str):
        return str.__str__(value)  # plain text also of an enumeration's member
    if isinstance(value, Integral):
        return int(value)
    if isinstance(value, Real):
        try:
            number = float(value)
        except OverflowError:  # a large fraction
            return _representation(value)
        if math.isnan(number):
            return None
        return number if math.isfinite(number) else repr(number)
    if id(value) in containers:
        return _representation(value)
    inside = (*containers, id(value))
    if isinstance(value, Mapping):
        return {_key(key): _plain(item, inside) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item, inside) for item in value]
    return _representation(value)


def _key(key: object) -> str:
    return str.__str__(key) if isinstance(key, str) else _representation(key)


def _representation(value: object) -> str:
    try:
        return repr(value)
    except Exception:  # a user's __repr__ may fail; the results of the run must not be lost over it
        return object.__repr__(value)
