"""Outcomes of frames and messages: counts by kind and outcome, as scalars and as ratios.

A frame has a reception at each radio that could decode it, and each reception has one outcome.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from gradysim.results.quantity import Average, Scalar, recorded

Counts = Mapping[str, Mapping[str, int]]
"""{kind of frame or message: {outcome: count}}."""

Outcomes = Mapping[str, Counts]
"""{ledger: its counts}; see `LEDGERS`."""

_UNDECIDED = {"queued", "in_air"}
"""Outcomes of frames and messages that were in progress at the end of the run."""

_OVERHEARD = " overheard"
"""End of the kinds of frames at radios to which they are not addressed."""


@dataclass(frozen=True)
class Ledger:
    """Table of outcomes.

    Attributes:
        title: Title of its table in the details.
        label: Label of the kinds of frames or messages in the summary.
        module: Module of its scalars, in the network; "" for the network itself.
        suffix: Suffix after the kind in the names of scalars.
    """

    title: str
    label: str
    module: str = ""
    suffix: str = ""


LEDGERS = {
    "frames": Ledger("Outcomes of frames, a reception for each radio", "receptions", "radioMedium"),
    "messages": Ledger("Messages", "messages", suffix="Message"),
}
"""In prototype mode each message has one frame."""


def plain_counts(counts: Counts) -> dict[str, dict[str, int]]:
    """Return counts as plain dicts. Large networks have millions of plain counts already."""
    return {kind: dict(outcomes) for kind, outcomes in counts.items()}


def outcome_scalars(outcomes: Outcomes, network: str) -> Iterator[Scalar]:
    """Yield `broadcast:delivered:count` and so on, of the whole network."""
    for name, counts in outcomes.items():
        ledger = LEDGERS[name]
        module = f"{network}.{ledger.module}" if ledger.module else network
        yield from count_scalars(counts, module, ledger.suffix)


def interface_scalars(interfaces: Mapping[str, Counts], node: str) -> Iterator[Scalar]:
    """Yield the outcomes of messages from a node, in a module for each of its interfaces."""
    for interface, counts in interfaces.items():
        yield from count_scalars(counts, f"{node}.{interface}", LEDGERS["messages"].suffix)


def count_scalars(counts: Counts, module: str, suffix: str = "") -> Iterator[Scalar]:
    """Yield a scalar for each count."""
    for kind, outcomes in counts.items():
        for outcome, count in outcomes.items():
            yield recorded(module, f"{_camel_case(kind)}{suffix}:{_camel_case(outcome)}:count", count)


def _camel_case(text: str) -> str:
    """Return `unicast overheard` and `below_sensitivity` in the style of OMNeT++'s models."""
    return re.sub(r"[ _](\w)", lambda match: match[1].upper(), text)


def outcome_ratios(outcomes: Mapping[str, Any]) -> Iterator[Average]:
    """Yield `unicast messages acknowledged`, its ratio of all decided messages, and so on.

    Messages have a ratio for each outcome, and frames the delivery ratio of receptions. Kinds without decided
    outcomes are left out, and so are overheard frames.
    """
    frames, messages = (outcomes.get(ledger) or {} for ledger in ("frames", "messages"))
    for outcome, ratio in _ratios(messages.get("unicast") or {}):
        yield Average(f"unicast messages {outcome}", ratio, outcome == "acknowledged")
    for outcome, ratio in _ratios(messages.get("broadcast") or {}):
        if outcome not in ("sent", "acknowledged"):  # all others are sent, and broadcasts have no ACK
            yield Average(f"broadcast messages {outcome}", ratio, outcome == "delivered")
    for kind, counts in frames.items():
        if not kind.endswith(_OVERHEARD):
            yield from _delivered(f"{kind} frames", counts)


def loss_shares(outcomes: Outcomes) -> dict[str, dict[str, float]]:
    """Return the share of receptions of each cause of loss, `{"broadcast frames": {"interference": 0.1}}`.

    Kinds of frames without receptions are left out, and so are overheard frames.
    """
    return {
        f"{kind} frames": {outcome: share for outcome, share in shares.items() if outcome != "delivered"}
        for kind, counts in (outcomes.get("frames") or {}).items()
        if not kind.endswith(_OVERHEARD) and (shares := dict(_ratios(counts)))
    }


def _delivered(what: str, counts: Mapping[str, int]) -> Iterator[Average]:
    if not any(counts.values()):  # as for most kinds
        return
    total = sum(count for outcome, count in counts.items() if outcome not in _UNDECIDED)
    if total and "delivered" in counts:
        yield Average(f"{what} delivered", counts["delivered"] / total)


def _ratios(counts: Mapping[str, int]) -> Iterator[tuple[str, float]]:
    known = decided(counts)
    total = sum(known.values())
    for outcome, count in known.items() if total else ():
        yield outcome, count / total


def decided(counts: Mapping[str, int]) -> dict[str, int]:
    """Return the counts by readable names of outcomes, without those still in progress."""
    return {_readable(outcome): count for outcome, count in counts.items() if outcome not in _UNDECIDED}


@cache
def _readable(outcome: str) -> str:
    return outcome.replace("_", " ")
