"""The replicated log of one node: a folded committed part and the entries after it.

What a log is for is the value of each variable, so the committed part is kept as those alone, "the base".
A log therefore never grows with time, one message can hold all of it, and a node that was away for long is
brought up to date by one message.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple


class Entry(NamedTuple):
    """One step of the log: from here on `name` has the value `value`. A name of None changes nothing."""

    term: int
    name: str | None
    value: Any


class RaftLog:
    """Entries are numbered from 1; those up to `base_index` are committed and folded into `values`.

    Attributes:
        base_index: Number of the last committed entry, 0 for none.
        base_term: Its term.
        values: Committed value of each variable that has one.
        entries: The entries after the base, those that are not known to be committed.
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
        """Number of the last entry, 0 for an empty log."""
        return self.base_index + len(self.entries)

    @property
    def last_term(self) -> int:
        """Term of the last entry, 0 for an empty log."""
        return self.entries[-1].term if self.entries else self.base_term

    def term_at(self, index: int) -> int | None:
        """Term of the entry with that number; None if it was folded away or does not exist."""
        if index == self.base_index:
            return self.base_term
        if self.base_index < index <= self.last_index:
            return self.entries[index - self.base_index - 1].term
        return None

    def latest_values(self) -> dict[str, Any]:
        """Return the value of each variable once everything in the log is committed."""
        values = dict(self.values)
        values.update((entry.name, entry.value) for entry in self.entries if entry.name is not None)
        return values

    def is_up_to_date(self, last_index: int, last_term: int) -> bool:
        """Whether a log that ends there has all that this one may have committed (Raft, section 5.4.1)."""
        return (last_term, last_index) >= (self.last_term, self.last_index)

    def append(self, entry: Entry) -> int:
        """Add an entry at the end and return its number."""
        self.entries.append(entry)
        return self.last_index

    def commit(self, index: int) -> None:
        """Fold everything up to `index`, which is in the log; no-op if that is committed already."""
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
        """Whether something committed here is not in the log of a leader.

        Where all majorities overlap this cannot be: see Leader Completeness in the Raft paper.
        """
        if leader.base_index > self.base_index:
            return False  # the leader's base says nothing about what came before
        term = leader.term_at(self.base_index)
        if term is None:
            # The leader's log was shorter when this was sent. Terms never decrease along a log: what it has
            # at our base by now is at least of the term in which its log ended then.
            return leader.last_term > self.base_term
        return term != self.base_term

    def follow(self, leader: "RaftLog") -> None:
        """Take over what a leader has, keeping what is ahead of it in the same history.

        Messages may come late, twice and in any order: only an entry that differs from the leader's is
        dropped, never one that the message is too old to know of.
        """
        if self.contradicts(leader) or (
            leader.base_index > self.base_index and self.term_at(leader.base_index) != leader.base_term
        ):
            self.base_index, self.base_term = leader.base_index, leader.base_term
            self.values, self.entries = dict(leader.values), list(leader.entries)
            return
        for index, entry in enumerate(leader.entries, start=leader.base_index + 1):
            if index > self.base_index and self.term_at(index) != entry.term:  # another one, or none yet
                del self.entries[index - self.base_index - 1 :]
                self.entries.append(entry)
        self.commit(leader.base_index)
