"""Whether a handler, or whatever has settings, was given the settings that it takes."""

from typing import TypeVar

T = TypeVar("T")


def checked_configuration(given: T | None, kind: type[T]) -> T:
    """Return what was given, or `kind()` for None. TypeError if it is no `kind`."""
    if given is None:
        return kind()
    if not isinstance(given, kind):
        raise TypeError(f"expected a {kind.__name__}, got {given!r}")
    return given
