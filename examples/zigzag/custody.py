"""Custody of data when messages can be lost."""


class Custody:
    """Readings that a node holds, and totals of the readings exchanged with each other node.

    A radio does not report whether a message arrived. If a message said "here are 12 readings", its sender
    could keep them, with a risk of duplicates, or drop them, with a risk of losses. Instead a message says "I
    have handed you 40 in total". The receiver takes what is new. A message that arrives twice adds nothing.
    The next message that arrives makes up for a lost one.

    So data is never duplicated. Readings in a lost message are in transit until the two nodes meet again. A
    real node would keep the readings themselves until then.
    """

    def __init__(self) -> None:
        self.held = 0
        """Readings that this node holds now."""
        self._given: dict[int, int] = {}
        self._taken: dict[int, int] = {}

    def given_to(self, peer: int) -> int:
        """Return the total of readings handed to `peer`, which a message to it contains."""
        return self._given.get(peer, 0)

    def taken_from(self, peer: int) -> int:
        """Return the total of readings received from `peer`."""
        return self._taken.get(peer, 0)

    def give_all(self, peer: int) -> None:
        """Hand all readings to `peer`. The next message to it says so."""
        self._given[peer] = self.given_to(peer) + self.held
        self.held = 0

    def take(self, peer: int, given: int) -> int:
        """Take the new readings of a message of `peer`, whose total is `given`. Return their number."""
        new = max(0, given - self.taken_from(peer))
        self._taken[peer] = self.taken_from(peer) + new
        self.held += new
        return new
