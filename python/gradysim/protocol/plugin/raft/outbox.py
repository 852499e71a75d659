"""What a node sends: broadcasts at once, replies to broadcasts a little later."""

from collections import deque

from gradysim.protocol.plugin.raft.cluster import Cluster
from gradysim.protocol.plugin.raft.environment import Environment
from gradysim.protocol.plugin.raft.membership import Membership
from gradysim.protocol.plugin.raft.node_timers import REPLY_TIMER, NodeTimers
from gradysim.protocol.plugin.raft.raft_message import RaftMessage


class Outbox:
    """Sends messages with what all of them carry."""

    def __init__(
        self, environment: Environment, membership: Membership, cluster: Cluster, timers: NodeTimers
    ) -> None:
        self._cluster = cluster
        self._environment = environment
        self._membership = membership
        self._timers = timers
        self._replies: deque[tuple[RaftMessage, int]] = deque()

    def broadcast(self, message: RaftMessage) -> None:
        """Send to everybody in reach."""
        self._send(message, None)

    def reply(self, message: RaftMessage, destination: int) -> None:
        """Send to one node once the next reply timer is due: others answer the same broadcast."""
        self._replies.append((message, destination))
        self._timers.add_reply()

    def send_reply(self) -> None:
        """A reply timer was due: send the oldest reply. No-op if there is none."""
        if self._replies:
            self._send(*self._replies.popleft())
        if self._replies:
            self._timers.pending.add(REPLY_TIMER)

    def clear(self) -> None:
        """Drop what was not sent yet."""
        self._replies.clear()
        self._timers.cancel(REPLY_TIMER)

    def _send(self, message: RaftMessage, destination: int | None) -> None:
        message.cluster_id = self._cluster.cluster_id
        if not self._membership.is_fixed:
            message.known_nodes = sorted(self._membership.known)
        self._environment.send(message.to_json(), destination)
