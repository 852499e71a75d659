"""Conversions of Python values to numbers, to values that JSON can hold, and to readable numbers.

Protocols may assign any object to a tracked variable. Results and viewers get plain values.
"""

import math
from collections.abc import Mapping, Set
from numbers import Integral, Real
from typing import Any

_DEEPEST = 100
"""Largest nesting depth of containers. JSON readers and Python's stack have such a limit, too."""

_DIGITS = 12
"""Digits of a readable number. The sum of thousands of steps is right to this many digits."""


def as_float(value: object) -> float | None:
    """Return a number or a bool as a float; None if `value` is not a number or is too large.

    Numbers of NumPy and its arrays without a dimension, such as `numpy.array(5)`, are numbers, too. An array
    of one number is a list, as in `plain_value`. Never raises.
    """
    try:
        if type(value).__module__ == "numpy" and hasattr(value, "tolist"):
            if getattr(value, "ndim", 0):  # avoids a list of all its items
                return None
            value = value.tolist()
        return float(value) if isinstance(value, Real) else None
    except Exception:  # too large, or a user's class that does not work
        return None


def readable_number(number: float) -> float:
    """Return `number` rounded to 12 digits: 59.9 for 59.90000000000058. Integers stay as they are.

    For text only. Results and files keep the exact number.
    """
    return number if number % 1 == 0 or number != number else float(f"{number:.{_DIGITS}g}")


def plain_value(value: object, *, nan: str | None = None) -> object:
    """Return `value` as None, bool, int, finite float, str, list or dict with str keys, at all depths.

    Numbers and arrays of NumPy become Python numbers and lists, tuples become lists, keys become strings. NaN
    becomes `nan`. A value without a form in JSON becomes its `repr`: a set, an object of a user's class, an
    infinity, a container inside itself. The items of a set are sorted. An integer of thousands of digits
    becomes a hexadecimal string, since Python does not print it as a decimal number. Never raises.
    """
    return _plain(value, nan, ())


def key_text(key: object) -> str:
    """Return the name of a tracked variable, which may be any object, as a string. Never raises."""
    return str.__str__(key) if isinstance(key, str) else _representation(key)


def _plain(value: Any, nan: str | None, containers: tuple[int, ...]) -> object:
    try:
        return _converted(value, nan, containers)
    except Exception:  # any method of a user's class may fail; results must not be lost
        return _representation(value)


def _converted(value: Any, nan: str | None, containers: tuple[int, ...]) -> object:
    if type(value).__module__ == "numpy" and hasattr(value, "tolist"):
        value = value.tolist()
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, str):
        return str.__str__(value)  # a plain str also for a member of an enumeration
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
        if type(value) in (set, frozenset) and value:
            return _set_representation(value)  # type: ignore[arg-type]
        return repr(value)
    except Exception:
        return object.__repr__(value)


def _set_representation(value: Set[object]) -> str:
    """Return the `repr` of a set with sorted items, whose order may otherwise differ between processes."""
    items = ", ".join(sorted(map(_representation, value), key=lambda text: (len(text), text)))
    return f"{{{items}}}" if type(value) is set else f"frozenset({{{items}}})"
