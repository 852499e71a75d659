"""Clusters: nodes in reach of each other that do not mix."""

from gradysim.protocol.plugin.raft.raft_message import RaftMessage


class Cluster:
    """The cluster of one node, and what it has heard of those of others.

    Attributes:
        cluster_id: None, too, is one: that of all that were not put into another.
    """

    def __init__(self) -> None:
        self.cluster_id: int | None = None
        self._heard: dict[int, int | None] = {}

    def accepts(self, message: RaftMessage) -> bool:
        """Whether a message comes from this cluster; the sender's is remembered in any case."""
        self._heard[message.sender_id] = message.cluster_id
        return message.cluster_id == self.cluster_id

    def knows(self, node_id: int) -> bool:
        """Whether that node was ever heard."""
        return node_id in self._heard

    def has(self, node_id: int) -> bool:
        """Whether that node was in this cluster when it was heard last; False for one never heard."""
        return node_id in self._heard and self._heard[node_id] == self.cluster_id
