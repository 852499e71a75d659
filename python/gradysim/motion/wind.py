"""The wind: constant, and gusts that differ from vehicle to vehicle."""

import math
from dataclasses import dataclass

from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.motion.gauss_markov import GaussMarkov, Vector

GUST_INTERVAL_S = 0.1
"""Time between two drawn velocities of a gust."""


@dataclass(frozen=True)
class Wind:
    """Wind of a scenario.

    Attributes:
        speed_mps: Of the constant wind, >= 0.
        heading_rad: Direction in which the air moves, from the x axis (North) to the y axis (East).
        gusts_mps: Standard deviation of the gusts on each axis, >= 0.
        gust_time_s: Correlation time of the gusts, > 0.
    """

    speed_mps: float = 0.0
    heading_rad: float = 0.0
    gusts_mps: float = 0.0
    gust_time_s: float = 10.0


class WindAtVehicle:
    """The wind at one vehicle."""

    def __init__(self, wind: Wind, seed: int, node: int) -> None:
        """Begin at time 0. The seed of the run and the id of the node name the stream of its gusts."""
        self._north_mps = wind.speed_mps * math.cos(wind.heading_rad)
        self._east_mps = wind.speed_mps * math.sin(wind.heading_rad)
        self._gusts = None
        if wind.gusts_mps > 0:
            deviations = (wind.gusts_mps, wind.gusts_mps, wind.gusts_mps)
            stream = RandomStream(seed, node, Purpose.GUSTS)
            self._gusts = GaussMarkov(stream, deviations, wind.gust_time_s, GUST_INTERVAL_S)

    def velocity_mps(self, time_s: float) -> Vector:
        """Return the velocity of the air North, East and down, at times that do not decrease."""
        if self._gusts is None:
            return (self._north_mps, self._east_mps, 0.0)
        north, east, down = self._gusts.at(time_s)
        return (self._north_mps + north, self._east_mps + east, down)
