"""Who holds which data, when messages can be lost."""


class Custody:
    """What a node holds, and an account of what went to and came from each other node.

    A radio does not tell whether a message arrived. If a message said "here are 12 readings", its sender
    could only guess: keep them, and perhaps they exist twice; drop them, and perhaps they are gone. So a
    message says instead "I have handed you 40 so far, in all". The receiver takes what is new to it: a
    message that comes twice adds nothing, and a lost one is made good by the next that gets through between
    the two.

    Data is thus never duplicated. What was handed over in a lost message is in transit until the two meet
    again; a real node would keep the readings themselves until then.
    """

    def __init__(self) -> None:
        self.held = 0
        """Readings that this node holds now."""
        self._given: dict[int, int] = {}
        self._taken: dict[int, int] = {}

    def given_to(self, peer: int) -> int:
        """Readings handed to `peer` so far, in all: what a message to it says."""
        return self._given.get(peer, 0)

    def taken_from(self, peer: int) -> int:
        """Readings that arrived from `peer` so far, in all."""
        return self._taken.get(peer, 0)

    def give_all(self, peer: int) -> None:
        """Hand everything to `peer`: the next message to it will say so."""
        self._given[peer] = self.given_to(peer) + self.held
        self.held = 0

    def take(self, peer: int, given: int) -> int:
        """Take what is new in a message of `peer` that has `given` so many in all; return how many."""
        new = max(0, given - self.taken_from(peer))
        self._taken[peer] = self.taken_from(peer) + new
        self.held += new
        return new
