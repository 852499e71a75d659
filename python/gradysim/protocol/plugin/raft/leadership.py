"""The volatile state of a leader: who has how much of its log, and who was heard when."""

from collections.abc import Collection

from gradysim.protocol.plugin.raft.membership import majority_of
from gradysim.protocol.plugin.raft.raft_log import RaftLog


class Leadership:
    """Progress of the followers in one term.

    Attributes:
        sent_s: When the latest heartbeat was sent; s.
        votes: How many nodes voted for the leader, itself among them.
    """

    def __init__(self, own_id: int, term: int, now_s: float, voters: Collection[int]) -> None:
        self._own_id = own_id
        self._term = term
        self._matched: dict[int, int] = {}
        self._heard_s = dict.fromkeys(voters, now_s)
        self.sent_s = now_s
        self.votes = len(voters)

    def heard(self, node_id: int, now_s: float) -> None:
        """Note that a follower answered."""
        self._heard_s[node_id] = now_s

    def matches(self, node_id: int, index: int) -> None:
        """Note that a follower has the log up to entry `index`. In one term that never becomes less."""
        self._matched[node_id] = max(self._matched.get(node_id, 0), index)

    def confirming(self, index: int) -> set[int]:
        """Ids of the followers that have the log up to entry `index`."""
        return {node_id for node_id, matched in self._matched.items() if matched >= index}

    def heard_since(self, time_s: float) -> set[int]:
        """Ids of the nodes heard at that time or later, the leader's own among them."""
        return {node_id for node_id, heard_s in self._heard_s.items() if heard_s >= time_s} | {self._own_id}

    def committable(self, log: RaftLog, electorate: Collection[int]) -> int:
        """Number of the last entry that may be committed: the majority of `electorate` has it.

        Only an entry of the leader's own term counts; with it all before it are committed (Raft, section
        5.4.2).
        """
        matched = sorted(
            (
                log.last_index if node_id == self._own_id else self._matched.get(node_id, 0)
                for node_id in electorate
            ),
            reverse=True,
        )
        index = matched[majority_of(len(matched)) - 1]
        return index if log.term_at(index) == self._term else log.base_index
