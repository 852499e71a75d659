"""Shared code of tests of flights on simulated time."""

import pytest

from gradysim.sitl import SitlError
from gradysim.sitl.autopilot_node import AutopilotNode

REFERENCE = (-15.84, -47.92, 1000.0)


def nodes(program, *starts, **settings):
    """Return nodes 0, 1, ... flown by the toy, named "vehicle 0" and so on."""
    return [
        AutopilotNode(number, f"vehicle {number}", start, program=program, user=None, **settings)
        for number, start in enumerate(starts)
    ]


def flown(flights, seconds, begin=0.0, step=0.01):
    """Return the positions of vehicle 0 at each step."""
    track = []
    for number in range(1, round(seconds / step) + 1):
        flights.advance_to(begin + number * step)
        track.append(flights.position(0))
    return track


def failure_of(flights_of, program, **settings):
    """Return the exception that ends a flight of one vehicle."""
    with pytest.raises(SitlError) as caught:
        flown(flights_of(program, (0.0, 0.0, 10.0), **settings), 5)
    return str(caught.value)
