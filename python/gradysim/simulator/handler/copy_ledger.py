"""Prototype mode's ledger: what became of each copy of each message.

A broadcast makes one copy for every other node, a message to one node one copy. The communication handler
tells the ledger what it decides when a message is sent; that a copy was delivered the ledger sees itself.
"""

from collections.abc import Iterable
from functools import partial

from gradysim.protocol.messages.communication import CommunicationCommandType
from gradysim.simulator.event import Callback, ScheduledEvent

KINDS = {CommunicationCommandType.BROADCAST: "broadcast", CommunicationCommandType.SEND: "unicast"}


class _Arrivals:
    """Copies of one kind that take one time."""

    def __init__(self) -> None:
        self.count = 0

    def deliver(self, receive: Callback) -> None:
        self.count += 1
        receive()


class _Counts:
    """Messages of one kind, and the copies of them."""

    def __init__(self) -> None:
        self.sent = 0
        self.carried = 0
        self.delivered: dict[float, _Arrivals] = {}  # by their delays; s
        self.out_of_range = 0
        self.lost = 0

    def after(self, delay_s: float) -> _Arrivals:
        arrivals = self.delivered.get(delay_s)
        if arrivals is None:
            arrivals = self.delivered[delay_s] = _Arrivals()
        return arrivals


class CopyLedger:
    """Counts for one simulation at a time."""

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        """Begin anew."""
        self._counts = {kind: _Counts() for kind in KINDS}

    def note(
        self,
        kind: CommunicationCommandType,
        copies: Iterable[ScheduledEvent],
        *,
        lost: int,
        out_of_range: int,
        delay_s: float,
    ) -> list[ScheduledEvent]:
        """Count a message that is sent.

        Args:
            kind: To one node or to all.
            copies: Those that will arrive, if the simulation gets as far as that.
            lost: Copies lost by the medium's failure rate.
            out_of_range: Copies for receivers out of range.
            delay_s: How long those that will arrive take.

        Returns:
            `copies`, which count themselves when they arrive.
        """
        counts = self._counts[kind]
        arrivals = counts.after(delay_s)
        counted: list[ScheduledEvent] = [
            (partial(arrivals.deliver, receive), context) for receive, context in copies
        ]
        counts.sent += 1
        counts.carried += len(counted)
        counts.lost += lost
        counts.out_of_range += out_of_range
        return counted

    def message_fates(self) -> dict[str, dict[str, int]]:
        """Return how many messages were sent: {kind: {"sent": count}}."""
        return {name: {"sent": self._counts[kind].sent} for kind, name in KINDS.items()}

    def delays(self) -> dict[str, dict[float, int]]:
        """Return how long the copies delivered until now took: {kind: {delay in s: count}}."""
        return {
            name: {delay_s: arrivals.count for delay_s, arrivals in self._counts[kind].delivered.items()}
            for kind, name in KINDS.items()
        }

    def copy_fates(self) -> dict[str, dict[str, int]]:
        """Return what became of the copies until now: {kind: {fate: count}}; the sum is all there were.

        "out_of_range" and "lost" (by the medium's failure rate) are decided when a message is sent; "in_air"
        has not arrived yet, and never will when the run is over, as what is sent from `finish`.
        """
        return {name: _fates(self._counts[kind]) for kind, name in KINDS.items()}


def _fates(counts: _Counts) -> dict[str, int]:
    delivered = sum(arrivals.count for arrivals in counts.delivered.values())
    return {
        "delivered": delivered,
        "out_of_range": counts.out_of_range,
        "lost": counts.lost,
        "in_air": counts.carried - delivered,
    }
