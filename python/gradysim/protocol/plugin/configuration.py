"""The second argument of a plugin that is told how to behave."""

from dataclasses import fields
from typing import TypeVar

T = TypeVar("T")


def configuration_or_default(plugin: object, given: T | None, kind: type[T]) -> T:
    """Return `given`, or a `kind` with its defaults in the place of None.

    Raises TypeError if it is no such configuration: the protocol, say, where both arguments are in each
    other's place.
    """
    if given is None:
        return kind()
    if not all(hasattr(given, field.name) for field in fields(kind)):  # type: ignore[arg-type]
        call = f"{type(plugin).__name__}(self, {kind.__name__}(...))"
        raise TypeError(f"expected `{call}`, got {given!r} as the configuration")
    return given
