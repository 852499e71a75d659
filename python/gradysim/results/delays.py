"""Delays of messages, from the protocol that sends one to the protocol that receives it."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import accumulate
from typing import Any

from gradysim.results.quantity import Average, Scalar, recorded

QUANTILES = (0.5, 0.9, 0.95, 0.99)
"""Quantiles in JSON objects."""

_NARROWEST_S = 1e-12
"""Width of the bin of a single value, so that it has a density."""


@dataclass(frozen=True)
class Delays:
    """Delays of the messages of one kind, one for each receiver; all times in seconds.

    A delay begins with the command to send and ends with `handle_packet`. It includes waiting for the
    channel, retries and the time on the air.

    Attributes:
        count: At least 1.
        bins: (begin, end, count) of each bin that is not empty, by time; `end` is just beyond it.
    """

    count: int
    sum_s: float
    sum_of_squares_s2: float
    min_s: float
    max_s: float
    bins: tuple[tuple[float, float, int], ...]

    @property
    def mean_s(self) -> float:
        """Mean."""
        return self._between_extremes(self.sum_s / self.count)

    @property
    def stddev_s(self) -> float:
        """Sample standard deviation; 0 for a single delay, and for equal ones."""
        if self.min_s == self.max_s:  # a difference of sums would leave a rounding error
            return 0.0
        squares = self.sum_of_squares_s2 - self.sum_s * self.mean_s
        return math.sqrt(max(0.0, squares) / (self.count - 1))

    def quantile_s(self, share: float) -> float:
        """Return the delay that the ratio `share` of all, 0 to 1, does not exceed.

        It is exact to 3 % in integrated mode, the width of the bins, and exact in prototype mode.
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
        """Return their JSON object."""
        return {
            "count": self.count,
            "mean_s": self.mean_s,
            "stddev_s": self.stddev_s,
            "min_s": self.min_s,
            "quantiles_s": {str(share): self.quantile_s(share) for share in QUANTILES},
            "max_s": self.max_s,
            "cumulative": self._cumulative(),
        }

    def _cumulative(self) -> dict[str, list[float]]:
        """Return times, and the ratio of the delays that do not exceed each: exact at these times."""
        counts = accumulate(count for _, _, count in self.bins)
        return {
            "time_s": [self._between_extremes(end) for _, end, _ in self.bins],
            "share": [count / self.count for count in counts],
        }


@dataclass(frozen=True)
class Histogram:
    """One distribution in a `.sca` file.

    Attributes:
        module: Full path, which starts with the name of the network.
    """

    module: str
    name: str
    values: Delays
    attributes: Mapping[str, str] = field(default_factory=dict)


def constant_delays(counts: Mapping[float, int]) -> Delays:
    """Return the delays of {delay in s: count}, with at least one message."""
    met = sorted((delay_s, count) for delay_s, count in counts.items() if count)
    return Delays(
        count=sum(count for _, count in met),
        sum_s=sum(delay_s * count for delay_s, count in met),
        sum_of_squares_s2=sum(delay_s**2 * count for delay_s, count in met),
        min_s=met[0][0],
        max_s=met[-1][0],
        bins=tuple((delay_s, math.nextafter(delay_s, math.inf), count) for delay_s, count in met),
    )


def delay_scalars(delays: Mapping[str, Delays], network: str) -> Iterator[Scalar]:
    """Yield `unicastMessage:delay:mean` and so on; `delays` are by the kind of message."""
    for kind, each in delays.items():
        for mode, value_s in (("mean", each.mean_s), ("max", each.max_s)):
            yield recorded(network, f"{kind}Message:delay:{mode}", value_s, "s")


def delay_histograms(delays: Mapping[str, Delays], network: str) -> Iterator[Histogram]:
    """Yield `unicastMessage:delay:histogram` and so on."""
    for kind, each in delays.items():
        source = f"{kind}Message:delay"
        attributes = {"unit": "s", "source": source, "recordingmode": "histogram"}
        yield Histogram(network, f"{source}:histogram", each, attributes)


def delay_averages(delays: Mapping[str, Any]) -> Iterator[Average]:
    """Yield `unicast messages delay in s` and so on, from the delays in a JSON object."""
    for kind, each in delays.items():
        yield Average(f"{kind} messages delay in s", each["mean_s"])


def bin_rows(values: Delays) -> Iterator[tuple[float, float]]:
    """Yield (lower edge, count) of adjacent bins, as OMNeT++'s table has them.

    The first row is what is below all bins, and the last one what is above them: both are empty.
    """
    yield float("-inf"), 0.0
    following = [begin for begin, _, _ in values.bins[1:]] + [math.inf]
    for (begin, end, count), next_begin in zip(values.bins, following, strict=True):
        yield begin, float(count)
        edge = max(end, min(begin + _NARROWEST_S, next_begin))
        if edge < next_begin:
            yield edge, 0.0
