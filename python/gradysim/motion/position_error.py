"""The error of the position that a node knows, as that of a satellite receiver: it drifts slowly."""

from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.motion.gauss_markov import GaussMarkov

POSITION_ERROR_TIME_S = 175.0
"""Correlation time by default: the median of four receivers at rest under open sky."""

POSITION_ERROR_RATIO = 2.3
"""Ratio of the vertical standard deviation to that of a horizontal axis, by default; likewise."""

_INTERVAL_S = 1.0
"""Time between two drawn errors."""


def position_error(
    seed: int, node: int, deviation_m: float, time_s: float, ratio: float = POSITION_ERROR_RATIO
) -> GaussMarkov:
    """Return the error (x, y, z) in meters of one node in the run with that seed.

    `deviation_m` is the standard deviation on each horizontal axis, `ratio` times as large that of z, and
    `time_s` the correlation time.
    """
    stream = RandomStream(seed, node, Purpose.POSITION_ERROR)
    return GaussMarkov(stream, (deviation_m, deviation_m, ratio * deviation_m), time_s, _INTERVAL_S)
