"""Messages and timers of a Raft node, through the provider of its protocol."""

from collections import deque
from random import Random

from gradysim.protocol.interface import IProvider
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.plugin.raft.membership_view import MembershipView
from gradysim.protocol.plugin.raft.raft_message import RaftMessage

RAFT_DISPATCH_PREFIX = "__RAFT__"
"""Marks messages and timers of the plugin."""

PREFIX = f"{RAFT_DISPATCH_PREFIX}:"
"""Prefix of every message and every timer of the plugin. Others belong to the protocol."""

REPLY_TIMER = "reply"


class Transport:
    """Messages and timers of one node. There is at most one timer with each name, except for replies.

    Attributes:
        random: The node's stream of random numbers.
        pending_timers: Names of the timers that are set.
    """

    def __init__(self, provider: IProvider, membership: MembershipView) -> None:
        self._provider = provider
        self._membership = membership
        self._replies: deque[tuple[RaftMessage, int]] = deque()
        # A provider need not be an IProvider, and may have no stream of random numbers.
        stream: Random | None = getattr(provider, "random", None)
        self.random = Random(provider.get_id()) if stream is None else stream
        self.pending_timers: set[str] = set()

    def now_s(self) -> float:
        """Return the time in seconds."""
        return self._provider.current_time()

    def broadcast(self, message: RaftMessage) -> None:
        """Send a message to all nodes in range now."""
        self._provider.send_communication_command(BroadcastMessageCommand(self._text_of(message)))

    def broadcast_text(self, text: str) -> None:
        """Broadcast any string with the plugin's prefix."""
        self._provider.send_communication_command(BroadcastMessageCommand(PREFIX + text))

    def reply(self, message: RaftMessage, destination: int, delay_s: float) -> None:
        """Send a message to one node after `delay_s` seconds. Replies are sent in the order of calls."""
        self._replies.append((message, destination))
        self._set_timer(REPLY_TIMER, delay_s)

    def send_next_reply(self) -> None:
        """Send the oldest reply when a reply timer fires. Do nothing if there is none."""
        if self._replies:
            message, destination = self._replies.popleft()
            self._provider.send_communication_command(SendMessageCommand(self._text_of(message), destination))
        if self._replies:
            self.pending_timers.add(REPLY_TIMER)

    def drop_replies(self) -> None:
        """Drop the replies that have not been sent."""
        self._replies.clear()
        self.cancel_timer(REPLY_TIMER)

    def restart_timer(self, name: str, delay_s: float) -> None:
        """Cancel the timer with that name, and set it to `delay_s` seconds from now."""
        self.cancel_timer(name)
        self._set_timer(name, delay_s)

    def cancel_timer(self, name: str) -> None:
        """Cancel the timers with that name. Do nothing if there are none."""
        if name in self.pending_timers:
            self.pending_timers.discard(name)
            self._provider.cancel_timer(PREFIX + name)

    def _set_timer(self, name: str, delay_s: float) -> None:
        self.pending_timers.add(name)
        self._provider.schedule_timer(PREFIX + name, self._provider.current_time() + delay_s)

    def _text_of(self, message: RaftMessage) -> str:
        message.cluster_id = self._membership.cluster_id
        if not self._membership.is_fixed:
            message.known_nodes = sorted(self._membership.known)
        return PREFIX + message.to_json()
