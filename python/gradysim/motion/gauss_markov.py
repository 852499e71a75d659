"""Random errors that change slowly: Gauss-Markov processes of first order."""

import math

from gradysim.encapsulator.random_stream import RandomStream

Vector = tuple[float, float, float]


class GaussMarkov:
    """Three independent Gaussian processes, whose correlation falls with exp(-lag / correlation time).

    Values are drawn at the multiples of an interval and linear between them. So they do not depend on the
    times at which they are asked for. The engine has the same numbers: cpp/netsim/mobility/gauss_markov.hpp.

    Source: P. S. Maybeck, Stochastic Models, Estimation and Control, volume 1, 1979, section 4.11.
    """

    def __init__(
        self, stream: RandomStream, deviations: Vector, correlation_time_s: float, interval_s: float
    ) -> None:
        """Create processes with these standard deviations. They are stationary from time 0 on."""
        self._stream = stream
        self._deviations = deviations
        self._interval_s = interval_s
        self._kept = math.exp(-interval_s / correlation_time_s)
        self._added = math.sqrt(1 - self._kept * self._kept)
        self._number = 0  # of the interval whose ends are known
        self._before = self._drawn()
        self._after = self._next()

    def at(self, time_s: float) -> Vector:
        """Return the values at a time >= 0, not before the interval of the latest call."""
        intervals = time_s / self._interval_s
        number = int(intervals)
        while self._number < number:
            self._number += 1
            self._before = self._after
            self._after = self._next()
        share = intervals - number
        x, y, z = self._before
        next_x, next_y, next_z = self._after
        dx, dy, dz = self._deviations
        return (
            dx * (x + share * (next_x - x)),
            dy * (y + share * (next_y - y)),
            dz * (z + share * (next_z - z)),
        )

    def _next(self) -> Vector:
        x, y, z = self._before
        a, b, c = self._drawn()
        kept, added = self._kept, self._added
        return (kept * x + added * a, kept * y + added * b, kept * z + added * c)

    def _drawn(self) -> Vector:
        """Draw three standard normal numbers.

        Source: G. E. P. Box, M. E. Muller, "A note on the generation of random normal deviates", 1958.
        """
        uniform = self._stream.random
        radius = math.sqrt(-2 * math.log(1 - uniform()))
        angle = 2 * math.pi * uniform()
        x, y = radius * math.cos(angle), radius * math.sin(angle)
        radius = math.sqrt(-2 * math.log(1 - uniform()))
        return (x, y, radius * math.cos(2 * math.pi * uniform()))
