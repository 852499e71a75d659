"""Which nodes a node takes for members of its cluster."""

from collections.abc import Iterable


class Membership:
    """Starts with the node itself and grows with every node heard of, until it is set once and for all.

    Attributes:
        is_fixed: Whether the members were set; then others are strangers.
    """

    def __init__(self, own_id: int) -> None:
        self._own_id = own_id
        self._known: frozenset[int] = frozenset({own_id})
        self.is_fixed = False

    @property
    def known(self) -> frozenset[int]:
        """Ids of all members, the node's own among them."""
        return self._known

    @property
    def others(self) -> frozenset[int]:
        """Ids of all members but the node itself."""
        return self._known - {self._own_id}

    @property
    def is_alone_by_choice(self) -> bool:
        """Whether the members were set to the node alone: then it needs nobody else."""
        return self.is_fixed and len(self._known) == 1

    def fix(self, node_ids: Iterable[int]) -> None:
        """Set the members; the node itself is always one."""
        self._known = frozenset({*node_ids, self._own_id})
        self.is_fixed = True

    def learn(self, node_ids: Iterable[int]) -> None:
        """Take those for members too, unless the members were set."""
        if not self.is_fixed:
            self._known = self._known.union(node_ids)

    def accepts(self, node_id: int) -> bool:
        """Whether messages of that node count."""
        return not self.is_fixed or node_id in self._known


def majority_of(count: int) -> int:
    """Smallest number of nodes that is more than half of `count`."""
    return count // 2 + 1
