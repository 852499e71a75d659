"""The three roles of a Raft node."""

from enum import Enum, auto


class RaftState(Enum):
    """What a node is doing at the moment.

    ```
               election timeout,                 majority of votes
               enough answers to discovery
    FOLLOWER ────────────────────────▶ CANDIDATE ─────────────────▶ LEADER
        ▲                                  │                          │
        └── leader or higher term seen, ◀──┴──────────────────────────┘
            election lost, quorum lost
    ```
    """

    FOLLOWER = auto()
    CANDIDATE = auto()
    LEADER = auto()

    def __str__(self) -> str:
        return self.name
