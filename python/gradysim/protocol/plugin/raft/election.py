"""The volatile state of a node that wants to lead: first it looks round, then it asks for votes."""

from dataclasses import dataclass, field


@dataclass
class Discovery:
    """Before an election: who is there, and who would vote for this node?

    Attributes:
        rounds_left: How many times more it asks those that have not answered.
        answered: Ids of the nodes that answered.
        willing: Those of them that would vote for it.
    """

    rounds_left: int
    answered: set[int] = field(default_factory=set)
    willing: set[int] = field(default_factory=set)


@dataclass
class Election:
    """Of the present term.

    Attributes:
        seen: Ids of the nodes seen active: those found before, and voters.
        votes: Ids of the nodes that voted for this one, itself among them.
    """

    seen: set[int]
    votes: set[int]
