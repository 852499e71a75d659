"""How long messages took, from the protocol that sent one to the protocol that got it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

QUANTILES = (0.5, 0.9, 0.95, 0.99)
"""Those that results tell."""


@dataclass(frozen=True)
class Delays:
    """Of the messages of one kind, once for each receiver whose protocol got one; all times in seconds.

    A delay begins with the command to send and ends with `handle_packet`: waiting for the channel, retries
    and the time on the air are part of it.

    Attributes:
        count: One at least.
        bins: (begin, end, how many are in it) of each bin that is not empty, by time; `end` is just beyond
            it.
    """

    count: int
    sum_s: float
    sum_of_squares_s2: float
    min_s: float
    max_s: float
    bins: tuple[tuple[float, float, int], ...]

    @property
    def mean_s(self) -> float:
        """Their mean."""
        return self._between_extremes(self.sum_s / self.count)

    @property
    def stddev_s(self) -> float:
        """Their sample standard deviation; 0 for a single one, and for equal ones."""
        if self.min_s == self.max_s:  # else what rounding has left of a difference of sums
            return 0.0
        squares = self.sum_of_squares_s2 - self.sum_s * self.mean_s
        return math.sqrt(max(0.0, squares) / (self.count - 1))

    def quantile_s(self, share: float) -> float:
        """Return the delay that `share` of all, 0 to 1, do not exceed, as exactly as the bins tell.

        That is to 3 % in integrated mode, and exactly in prototype mode.
        """
        rank, before = share * self.count, 0
        for begin, end, count in self.bins:
            if before + count >= rank:
                within = begin + (end - begin) * (rank - before) / count
                return self._between_extremes(within)
            before += count
        return self.max_s

    def _between_extremes(self, time_s: float) -> float:
        return min(max(time_s, self.min_s), self.max_s)

    def to_json_object(self) -> dict[str, object]:
        """Return what results tell of them."""
        return {
            "count": self.count,
            "mean_s": self.mean_s,
            "stddev_s": self.stddev_s,
            "min_s": self.min_s,
            "quantiles_s": {str(share): self.quantile_s(share) for share in QUANTILES},
            "max_s": self.max_s,
        }


def constant_delays(counts: Mapping[float, int]) -> Delays:
    """Return the delays {delay in s: how many messages took just that}; one message at least."""
    met = sorted((delay_s, count) for delay_s, count in counts.items() if count)
    return Delays(
        count=sum(count for _, count in met),
        sum_s=sum(delay_s * count for delay_s, count in met),
        sum_of_squares_s2=sum(delay_s**2 * count for delay_s, count in met),
        min_s=met[0][0],
        max_s=met[-1][0],
        bins=tuple((delay_s, math.nextafter(delay_s, math.inf), count) for delay_s, count in met),
    )
