"""Flooding: a message reaches all nodes of a network, relayed by each of them once."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand

_ORIGIN_TIMER = "flood"


class Flood(IProtocol):
    """The origin broadcasts number k at first_send + k * interval; each other node relays it once.

    A message is "NUMBER HOPS ", padded with x to `payload_bytes`. HOPS is 1 at the origin and grows by one
    with each relay.

    Tracked variables, at the end:
        sent: Messages of this node.
        received: Messages received, each counted once.
        duplicates: Messages received again.
        relayed: Messages relayed.
        most_hops: Largest number of hops of a received message.
    """

    origin: int = 0
    """Id of the node that originates the messages."""
    first_send: float = 1.0
    """Seconds; not negative."""
    interval: float = 1.0
    """Seconds between two messages of the origin, > 0."""
    stop: float = 60.9
    """Seconds; the origin does not send from this time on."""
    jitter: float = 0.01
    """Longest delay of a relay in seconds, drawn for each.

    Otherwise neighbors would relay at the same instant.
    """
    hop_limit: int = 16
    """Number of hops after which a message is not relayed any more."""
    payload_bytes: int = 100
    """Size of a message; larger if its numbers need it."""

    def initialize(self) -> None:
        """Schedule the first message of the origin."""
        if not self.interval > 0:
            raise ValueError(f"interval is {self.interval} s, expected more than 0 s")
        self._known: set[int] = set()
        self._counts = dict.fromkeys(("sent", "received", "duplicates", "relayed", "most_hops"), 0)
        if self.provider.get_id() == self.origin:
            self._schedule()

    def _schedule(self) -> None:
        time = self.first_send + self._counts["sent"] * self.interval
        if time < self.stop:
            self.provider.schedule_timer(_ORIGIN_TIMER, time)

    def _text(self, number: int, hops: int) -> str:
        return f"{number} {hops} ".ljust(self.payload_bytes, "x")

    def handle_timer(self, timer: str) -> None:
        """Send the origin's next message, or relay the message in the timer's name."""
        if timer != _ORIGIN_TIMER:
            self.provider.send_communication_command(BroadcastMessageCommand(timer))
            self._counts["relayed"] += 1
            return
        number = self._counts["sent"]
        self._known.add(number)
        self.provider.send_communication_command(BroadcastMessageCommand(self._text(number, hops=1)))
        self._counts["sent"] += 1
        self._schedule()

    def handle_packet(self, message: str) -> None:
        """Count the message, and relay it if it is new."""
        number, hops = map(int, message.split(" ", 2)[:2])
        if number in self._known:
            self._counts["duplicates"] += 1
            return
        self._known.add(number)
        self._counts["received"] += 1
        self._counts["most_hops"] = max(self._counts["most_hops"], hops)
        if hops < self.hop_limit:
            delay = self.provider.random.uniform(0, self.jitter)
            self.provider.schedule_timer(self._text(number, hops + 1), self.provider.current_time() + delay)

    def finish(self) -> None:
        """Track the counts."""
        self.provider.tracked_variables.update(self._counts)
