"""Position of a station: straight lines at constant speed, and a full stop at each target."""

from dataclasses import dataclass
from math import dist

from verification.oracle.case import Point, Station


@dataclass(frozen=True)
class _Leg:
    start_ps: int
    origin: Point
    target: Point
    speed_mps: float

    def position_at(self, time_ps: int) -> Point:
        length_m = dist(self.origin, self.target)
        flown_m = self.speed_mps * (time_ps - self.start_ps) * 1e-12
        if flown_m >= length_m:
            return self.target
        share = flown_m / length_m
        x, y, z = (
            here + (there - here) * share for here, there in zip(self.origin, self.target, strict=True)
        )
        return x, y, z


class Flight:
    """Path of one station over the whole run."""

    def __init__(self, station: Station) -> None:
        self._legs = [_Leg(0, station.position, station.position, 0.0)]
        for course in sorted(station.courses, key=lambda course: course.time_ns):
            start_ps = course.time_ns * 1000
            here = self._legs[-1].position_at(start_ps)
            self._legs.append(_Leg(start_ps, here, course.target, course.speed_mps))

    def position_at(self, time_ps: int) -> Point:
        """Return its position at that time, in meters."""
        return next(leg for leg in reversed(self._legs) if leg.start_ps <= time_ps).position_at(time_ps)
