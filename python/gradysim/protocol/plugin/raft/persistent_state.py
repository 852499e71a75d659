"""What a node must not forget when it crashes."""

from dataclasses import dataclass, field

from gradysim.protocol.plugin.raft.raft_log import RaftLog


@dataclass
class PersistentState:
    """Survives a crash; everything else about a node is made anew when it starts again.

    Attributes:
        current_term: Highest term that the node has seen, 0 at first.
        voted_for: Id of the candidate that got the node's vote in that term, if any.
        log: The entries, and what is committed of them.
    """

    current_term: int = 0
    voted_for: int | None = None
    log: RaftLog = field(default_factory=RaftLog)
