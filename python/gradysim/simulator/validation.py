"""Checks of what scripts pass to the simulator: configurations, protocols and reference coordinates."""

from collections.abc import Iterable
from typing import TypeVar

from gradysim.protocol.checked_values import is_in_range
from gradysim.protocol.interface import IProtocol

T = TypeVar("T")


def checked_configuration(given: T | None, kind: type[T]) -> T:
    """Return `given`, or `kind()` for None. TypeError if it is not a `kind`."""
    if given is None:
        return kind()
    if not isinstance(given, kind):
        raise TypeError(f"expected a {kind.__name__}, got {given!r}")
    return given


def checked_protocol_class(protocol: type[IProtocol]) -> type[IProtocol]:
    """Return `protocol`. TypeError if it is not a class, or a class without `instantiate`."""
    if not isinstance(protocol, type) or not hasattr(protocol, "instantiate"):
        raise TypeError(f"expected a protocol's class, a subclass of IProtocol, got {protocol!r}")
    return protocol


def check_reference(reference: Iterable[object]) -> None:
    """Check (latitude deg, longitude deg, altitude m). ValueError if it is not a place on Earth."""
    try:
        latitude, longitude, altitude = reference
    except (TypeError, ValueError):
        latitude = longitude = altitude = None
    if not (is_in_range(latitude, -90, 90) and is_in_range(longitude) and is_in_range(altitude)):
        raise ValueError(
            "reference_coordinates must be (latitude -90 to 90 degrees, longitude degrees, altitude m), "
            f"got {reference!r}"
        )
