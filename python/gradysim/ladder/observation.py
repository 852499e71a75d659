"""What one run of a campaign showed."""

from collections import Counter
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from gradysim.ladder.failure import Failure
from gradysim.results.outcomes import Outcomes

LOST_MESSAGES = ("queue_overflow", "retry_limit", "channel_access_failure")
"""Outcomes of messages that their sender gave up."""

_NOT_LOST = {"delivered", "below_sensitivity", "in_air"}
"""Outcomes of receptions that are not losses, or that are out of range."""


@dataclass(frozen=True)
class Observation:
    """What one run showed. A run that failed has no numbers.

    Attributes:
        numbers: {quantity: its value}, as `gradysim means` names them.
        losses: {outcome: receptions lost} of frames at their addressees.
        receptions: Receptions within the range that have ended.
        messages: {outcome: messages}.
        failure: Why it failed; None if it came to its end.
        binary: Names of the quantities that are 0 or 1, see `RunSummary.is_binary`.
        has_all: Whether `numbers` has all quantities of the run. Of very many, it has those asked for.
    """

    numbers: Mapping[str, float] = field(default_factory=dict)
    losses: Mapping[str, int] = field(default_factory=dict)
    receptions: int = 0
    messages: Mapping[str, int] = field(default_factory=dict)
    failure: Failure | None = None
    binary: tuple[str, ...] = ()
    has_all: bool = True

    def has(self, quantities: Collection[str]) -> bool:
        """Return whether the numbers tell the value of these quantities."""
        return self.failure is not None or self.has_all or all(name in self.numbers for name in quantities)


def losses_of(outcomes: Outcomes) -> tuple[dict[str, int], int]:
    """Return the lost receptions by outcome, and the number of those within range that have ended."""
    losses: Counter[str] = Counter()
    receptions = 0
    for kind, counts in outcomes["frames"].items():
        if kind.endswith("overheard"):
            continue
        receptions += sum(counts.values()) - counts.get("below_sensitivity", 0) - counts.get("in_air", 0)
        losses.update({outcome: n for outcome, n in counts.items() if n and outcome not in _NOT_LOST})
    return dict(losses), receptions


def messages_of(outcomes: Outcomes) -> dict[str, int]:
    """Return the number of messages by outcome, of all kinds."""
    messages: Counter[str] = Counter()
    for counts in outcomes["messages"].values():
        messages.update(counts)
    return dict(messages)
