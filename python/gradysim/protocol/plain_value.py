"""Any Python value as one that JSON can hold.

For tracked variables, which protocols may fill with whatever they like: in the results of a run, and in what
viewers are shown.
"""

import math
from collections.abc import Mapping
from numbers import Integral, Real
from typing import Any

_DEEPEST = 100
"""Containers inside of each other; readers of JSON have such a limit, too, and so has Python's stack."""


def plain_value(value: object, *, nan: str | None = None) -> object:
    """Return `value` as None, bool, int, finite float, str, list or dict with text keys, all the way down.

    Numbers and arrays of numpy become Python's, tuples become lists, keys become text. NaN, which stands for
    no number, becomes `nan`. What JSON has no form for, such as a set, an object of a user's class, an
    infinity, or a container inside itself, is given as its `repr`; an integer of thousands of digits, which
    Python does not write as a decimal number, as a hexadecimal one. Never raises.
    """
    return _plain(value, nan, ())


def key_text(key: object) -> str:
    """Return the name of a tracked variable, which may be any object, as a text. Never raises."""
    return str.__str__(key) if isinstance(key, str) else _representation(key)


def _plain(value: Any, nan: str | None, containers: tuple[int, ...]) -> object:
    try:
        return _converted(value, nan, containers)
    except Exception:  # whatever a user's class is asked for may fail; results must not be lost over it
        return _representation(value)


def _converted(value: Any, nan: str | None, containers: tuple[int, ...]) -> object:
    if type(value).__module__ == "numpy" and hasattr(value, "tolist"):
        value = value.tolist()
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, str):
        return str.__str__(value)  # plain text also of an enumeration's member
    if isinstance(value, Integral):
        return _integer(int(value))
    if isinstance(value, Real):
        number = float(value)
        if math.isnan(number):
            return nan
        return number if math.isfinite(number) else repr(number)
    if id(value) in containers or len(containers) == _DEEPEST:
        return _representation(value)
    inside = (*containers, id(value))
    if isinstance(value, Mapping):
        return {key_text(key): _plain(item, nan, inside) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item, nan, inside) for item in value]
    return _representation(value)


def _integer(number: int) -> int | str:
    try:
        str(number)
    except ValueError:  # more digits than sys.get_int_max_str_digits()
        return hex(number)
    return number


def _representation(value: object) -> str:
    try:
        return repr(value)
    except Exception:
        return object.__repr__(value)
