"""Values of consensus variables: what JSON carries is what all nodes get, the proposing one too.

The type of the whole value stays what it is. Inside of lists, tuples and dicts a tuple becomes a list, a
number of an enumeration a plain one, and a key of a dict its text in JSON: `{1: (2, 3)}` becomes
`{"1": [2, 3]}`.
"""

import json
from typing import Any


def carried_value(name: str, kind: type, value: object) -> Any:
    """Return a value as it comes out of a message, independent of the one passed in.

    Raises:
        ValueError: It is not of the variable's type, or JSON does not carry it faithfully.
    """
    if not isinstance(value, kind):
        raise ValueError(
            f"a value of the consensus variable {name!r} must be of type {kind.__name__}, got {value!r}"
        )
    try:
        carried = json.loads(json.dumps(value))
    except (TypeError, ValueError, RecursionError) as error:
        raise ValueError(f"JSON cannot carry {value!r} as value of {name!r}: {error}") from None
    if not isinstance(typed_value(kind, carried), kind):
        raise ValueError(
            f"JSON cannot carry {value!r} as value of {name!r}: a {kind.__name__} arrives as {carried!r}"
        )
    return carried


def typed_value(kind: type, carried: object) -> Any:
    """Return a copy of a value that came out of a message, as the type of its variable."""
    if kind is tuple and isinstance(carried, list):
        carried = tuple(carried)
    return json.loads(json.dumps(carried)) if isinstance(carried, list | dict) else carried


def same_value(first: object, second: object) -> bool:
    """Whether two values that came out of messages are the same; 1, 1.0 and True are not."""
    return json.dumps(first, sort_keys=True) == json.dumps(second, sort_keys=True)
