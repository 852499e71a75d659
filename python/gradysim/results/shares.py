"""What became of messages and frames in one run, as numbers that can be compared between runs and modes."""

from collections.abc import Iterator, Mapping
from typing import Any

ALWAYS_TOLD = (" acknowledged", " delivered", " delay in s")
"""Ends of the quantities that say something when they are 0, too."""

_UNDECIDED = {"queued", "in_air"}
"""The fates of what was still under way when the run ended."""


def shares(fates: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    """Yield (`unicast messages acknowledged`, share of all that had a fate at the end), and the like.

    `fates` are those of a `RunResult`. Of messages there is a share for each fate; of frames, and of
    broadcasts in prototype mode, that of the copies that were delivered. Kinds of which nothing was decided
    are left out, and so are frames that were overheard.
    """
    copies, frames, messages = (fates.get(what) or {} for what in ("copies", "frames", "messages"))
    # In prototype mode a message to one node is one copy, whose fate is that of the message.
    unicast = copies.get("unicast") or messages.get("unicast") or {}
    yield from ((f"unicast messages {fate}", share) for fate, share in _shares(unicast))
    for fate, share in _shares(messages.get("broadcast") or {}):
        if fate not in ("sent", "acknowledged"):  # sent are all others; nobody acknowledges them
            yield f"broadcast messages {fate}", share
    for kind, counts in frames.items():
        if not kind.endswith(" overheard"):
            yield from _delivered(f"{kind} frames", counts)
    yield from _delivered("broadcast copies", copies.get("broadcast") or {})


def mean_delays(delays: Mapping[str, Any]) -> dict[str, float]:
    """Return {`unicast messages delay in s`: the mean}, and the like, of the delays that a result tells."""
    return {f"{kind} messages delay in s": told["mean_s"] for kind, told in delays.items()}


def _delivered(what: str, counts: Mapping[str, int]) -> Iterator[tuple[str, float]]:
    return ((f"{what} delivered", share) for fate, share in _shares(counts) if fate == "delivered")


def _shares(counts: Mapping[str, int]) -> Iterator[tuple[str, float]]:
    decided = {fate: count for fate, count in counts.items() if fate not in _UNDECIDED}
    of_all = sum(decided.values())
    for fate, count in decided.items() if of_all else ():
        yield fate.replace("_", " "), count / of_all
