"""The distributions of a run, under names in OMNeT++'s manner."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from gradysim.results.delays import Delays
from gradysim.results.run_result import RunResult

_NARROWEST_S = 1e-12
"""Of a bin for a single value, so that a density can be told of it."""


@dataclass(frozen=True)
class Histogram:
    """How often which value was met.

    Attributes:
        module: The whole path, which begins with the name of the network.
    """

    module: str
    name: str
    values: Delays
    attributes: Mapping[str, str] = field(default_factory=dict)


def histograms(result: RunResult, network: str) -> Iterator[Histogram]:
    """Give the distributions of a run; the paths of their modules begin with `network`."""
    for kind, delays in result.message_delays.items():
        name = f"{kind}Message:delay"
        attributes = {"unit": "s", "source": name, "recordingmode": "histogram"}
        yield Histogram(network, f"{name}:histogram", delays, attributes)


def rows_of_bins(values: Delays) -> Iterator[tuple[float, float]]:
    """Give the rows of OMNeT++'s table of bins: (lower edge, count), without gaps.

    The first one is what is below all bins, the last one what is above them; nothing is.
    """
    yield float("-inf"), 0.0
    following = [begin for begin, _, _ in values.bins[1:]] + [math.inf]
    for (begin, end, count), next_begin in zip(values.bins, following, strict=True):
        yield begin, float(count)
        edge = max(end, min(begin + _NARROWEST_S, next_begin))
        if edge < next_begin:
            yield edge, 0.0
