"""Whether the origin of a handler's frame is a place on the Earth."""

import math
from collections.abc import Iterable

from gradysim.simulator.number_range import is_in_range


def check_reference(place: Iterable[object]) -> None:
    """Check (latitude deg, longitude deg, altitude m); ValueError if it is none."""
    try:
        latitude, longitude, altitude = place
    except (TypeError, ValueError):
        latitude = longitude = altitude = None
    if not is_in_range(latitude, -90, 90) or not all(
        is_in_range(value, -math.inf, above=True) for value in (longitude, altitude)
    ):
        raise ValueError(
            "reference_coordinates must be (latitude -90 to 90 degrees, longitude degrees, altitude m), "
            f"got {place!r}"
        )
