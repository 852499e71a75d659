"""The state of a Raft node: its role, its term and vote, and its log (Figure 2 of the Raft paper)."""

import json
import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum, auto
from typing import Any, NamedTuple


class RaftState(Enum):
    """Role of a node.

    ::

                   election timeout,                 majority of votes
                   enough answers to discovery
        FOLLOWER ────────────────────────▶ CANDIDATE ─────────────────▶ LEADER
            ▲                                  │                          │
            └── leader or higher term seen, ◀──┴──────────────────────────┘
                election lost, quorum lost
    """

    FOLLOWER = auto()
    CANDIDATE = auto()
    LEADER = auto()

    def __str__(self) -> str:
        return self.name


class Entry(NamedTuple):
    """Log entry that sets the variable `name` to `value`. A name of None changes nothing."""

    term: int
    name: str | None
    value: Any


class RaftLog:
    """The replicated log. Entries are numbered from 1.

    Only the latest value of each variable matters, so the committed part is stored as these values alone. The
    log does not grow with time, and one message with the whole log brings a node up to date.

    Attributes:
        base_index: Index of the last committed entry, 0 if there is none.
        base_term: Term of that entry.
        values: Committed value of each variable that has one.
        entries: The entries after `base_index`, which are not known to be committed.
    """

    def __init__(
        self,
        base_index: int = 0,
        base_term: int = 0,
        values: Mapping[str, Any] | None = None,
        entries: Sequence[Entry] = (),
    ) -> None:
        self.base_index = base_index
        self.base_term = base_term
        self.values: dict[str, Any] = dict(values or {})
        self.entries: list[Entry] = list(entries)

    @property
    def last_index(self) -> int:
        """Index of the last entry, 0 for an empty log."""
        return self.base_index + len(self.entries)

    @property
    def last_term(self) -> int:
        """Term of the last entry, 0 for an empty log."""
        return self.entries[-1].term if self.entries else self.base_term

    def term_at(self, index: int) -> int | None:
        """Return the term of an entry, or None if it is stored only as a value or does not exist."""
        if index == self.base_index:
            return self.base_term
        if self.base_index < index <= self.last_index:
            return self.entries[index - self.base_index - 1].term
        return None

    def latest_values(self) -> dict[str, Any]:
        """Return the value of each variable, including entries that are not committed."""
        values = dict(self.values)
        values.update((entry.name, entry.value) for entry in self.entries if entry.name is not None)
        return values

    def is_up_to_date(self, last_index: int, last_term: int) -> bool:
        """Whether a log with that end is at least as up to date as this one (Raft, section 5.4.1)."""
        return (last_term, last_index) >= (self.last_term, self.last_index)

    def append(self, entry: Entry) -> int:
        """Append an entry and return its index."""
        self.entries.append(entry)
        return self.last_index

    def commit(self, index: int) -> None:
        """Commit all entries up to `index`, which must exist. Do nothing if they are already committed."""
        count = index - self.base_index
        if count <= 0:
            return
        for entry in self.entries[:count]:
            if entry.name is not None:
                self.values[entry.name] = entry.value
        self.base_term = self.entries[count - 1].term
        self.base_index = index
        del self.entries[:count]

    def contradicts(self, leader: "RaftLog") -> bool:
        """Whether an entry that is committed here is missing in the leader's log.

        This cannot happen if all majorities overlap (Leader Completeness, section 5.4.3 of the Raft paper).
        """
        if leader.base_index > self.base_index:
            return False  # the leader's committed values do not tell which entries they came from
        term = leader.term_at(self.base_index)
        if term is None:
            # The leader's log was shorter when it sent this. Terms never decrease along a log, so the
            # leader's entry at self.base_index has at least the last term of this shorter log.
            return leader.last_term > self.base_term
        return term != self.base_term

    def follow(self, leader: "RaftLog") -> None:
        """Take over the log of a leader.

        Messages may be late, repeated or out of order. So an entry is dropped only if it conflicts with the
        leader's log, not if the message is too old to contain it.
        """
        if self.contradicts(leader) or (
            leader.base_index > self.base_index and self.term_at(leader.base_index) != leader.base_term
        ):
            self.base_index, self.base_term = leader.base_index, leader.base_term
            self.values, self.entries = dict(leader.values), list(leader.entries)
            return
        for index, entry in enumerate(leader.entries, start=leader.base_index + 1):
            if index > self.base_index and self.term_at(index) != entry.term:  # a conflict, or a new entry
                del self.entries[index - self.base_index - 1 :]
                self.entries.append(entry)
        self.commit(leader.base_index)


@dataclass
class PersistentState:
    """State that survives a crash of the node.

    Attributes:
        current_term: Highest term that the node has seen, 0 at first.
        voted_for: Id of the candidate that the node voted for in `current_term`, if any.
        log: The log.
    """

    current_term: int = 0
    voted_for: int | None = None
    log: RaftLog = field(default_factory=RaftLog)


@dataclass
class Discovery:
    """State of a follower that looks for voters before an election (PreVote).

    Attributes:
        rounds_left: Number of remaining rounds of requests to nodes that have not answered.
        answered: Ids of the nodes that answered.
        willing: Ids of the nodes that would vote for this one.
    """

    rounds_left: int
    answered: set[int] = field(default_factory=set)
    willing: set[int] = field(default_factory=set)


@dataclass
class Election:
    """State of a candidate.

    Attributes:
        seen: Ids of the nodes that are seen active: those that answered the discovery, and voters.
        votes: Ids of the nodes that voted for this one, including itself.
    """

    seen: set[int]
    votes: set[int]


class Leadership:
    """State of a leader: which entries its followers have, and when they answered.

    Attributes:
        sent_s: Time (s) of the latest AppendEntries.
        votes: Number of nodes that voted for the leader, including itself.
    """

    def __init__(self, own_id: int, term: int, now_s: float, voters: Collection[int]) -> None:
        self._own_id = own_id
        self._term = term
        self._match_index: dict[int, int] = {}
        self._heard_s = dict.fromkeys(voters, now_s)
        self.sent_s = now_s
        self.votes = len(voters)

    def heard(self, node_id: int, now_s: float) -> None:
        """Record that a follower answered."""
        self._heard_s[node_id] = now_s

    def matches(self, node_id: int, index: int) -> None:
        """Record that a follower has the log up to `index`. It never decreases within a term."""
        self._match_index[node_id] = max(self._match_index.get(node_id, 0), index)

    def confirming(self, index: int) -> set[int]:
        """Return the ids of the followers that have the log up to `index`."""
        return {node_id for node_id, matched in self._match_index.items() if matched >= index}

    def heard_since(self, time_s: float) -> set[int]:
        """Return the ids of the nodes that answered at `time_s` or later, including the leader."""
        return {node_id for node_id, heard_s in self._heard_s.items() if heard_s >= time_s} | {self._own_id}

    def committable(self, log: RaftLog, electorate: Collection[int]) -> int:
        """Return the index of the last entry that a majority of `electorate` has.

        Only entries of the leader's own term count. They commit all entries before them (Raft, section
        5.4.2).
        """
        matched = sorted(
            (
                log.last_index if node_id == self._own_id else self._match_index.get(node_id, 0)
                for node_id in electorate
            ),
            reverse=True,
        )
        index = matched[majority_of(len(matched)) - 1]
        return index if log.term_at(index) == self._term else log.base_index


def majority_of(count: int) -> int:
    """Return the smallest number of nodes that is more than half of `count`."""
    return count // 2 + 1


def next_own_term(current_term: int, node_id: int) -> int:
    """Return the smallest term of node `node_id` (>= 0) that is higher than `current_term` (>= 0).

    Each term belongs to one node. The Raft paper numbers terms 1, 2, 3, … and relies on overlapping
    majorities to have one leader in each. Here majorities need not overlap: nodes may know different members,
    and in fault-tolerant mode both sides of a partition can have a majority. So terms are arranged in rows,
    and row r has one term for each of the nodes 0 to r::

        row 0: 1 (node 0)
        row 1: 2 (node 0)  3 (node 1)
        row 2: 4 (node 0)  5 (node 1)  6 (node 2)

    The number of nodes need not be known, and terms stay small. Ballot numbers in Paxos are owned by
    proposers in the same way.
    """
    if current_term == 0:
        return _term(node_id, node_id)
    row = (math.isqrt(8 * (current_term - 1) + 1) - 1) // 2
    owner = current_term - _term(row, 0)
    if owner < node_id <= row:
        return _term(row, node_id)
    return _term(max(row + 1, node_id), node_id)


def _term(row: int, node_id: int) -> int:
    return row * (row + 1) // 2 + node_id + 1


def json_value(name: str, var_type: type, value: object) -> Any:
    """Return an independent copy of `value` as it is decoded from a JSON message.

    All nodes get this copy, including the one that proposes it. The type of the whole value is kept. Inside
    lists, tuples and dicts, tuples become lists, enumeration members become numbers and keys become strings:
    `{1: (2, 3)}` becomes `{"1": [2, 3]}`.

    Raises:
        ValueError: The value does not have the type of the variable, or JSON changes its type.
    """
    if not isinstance(value, var_type):
        raise ValueError(
            f"a value of the consensus variable {name!r} must be of type {var_type.__name__}, got {value!r}"
        )
    try:
        received = json.loads(json.dumps(value))
    except (TypeError, ValueError, RecursionError) as error:
        raise ValueError(f"JSON cannot carry {value!r} as value of {name!r}: {error}") from None
    if not isinstance(typed_value(var_type, received), var_type):
        raise ValueError(
            f"JSON cannot carry {value!r} as value of {name!r}: {var_type.__name__} arrives as {received!r}"
        )
    return received


def typed_value(var_type: type, received: object) -> Any:
    """Return a copy of a value from a message, converted to the type of its variable."""
    if var_type is tuple and isinstance(received, list):
        received = tuple(received)
    return json.loads(json.dumps(received)) if isinstance(received, list | dict) else received


def same_value(first: object, second: object) -> bool:
    """Whether two values are the same in JSON. 1, 1.0 and True differ."""
    return json.dumps(first, sort_keys=True) == json.dumps(second, sort_keys=True)
