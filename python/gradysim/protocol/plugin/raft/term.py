"""Which terms a node may lead: every term belongs to exactly one node.

Textbook Raft numbers terms 1, 2, 3, ... and relies on overlapping majorities for there to be one leader in
each. Here majorities need not overlap (nodes may know different members, and in fault-tolerant mode a
partition has two majorities), so the number itself settles it: terms are laid out in rows, row r holds one
term of each of the nodes 0 to r.

```
row 0: 1 (node 0)
row 1: 2 (node 0)  3 (node 1)
row 2: 4 (node 0)  5 (node 1)  6 (node 2)
...
```

Nobody needs to know how many nodes there are, each node has a term above any given one, and numbers stay
small: the first rows of n nodes end at n * (n + 1) / 2. The same idea as a proposer's own ballot numbers in
Paxos.
"""

import math


def next_own_term(current_term: int, node_id: int) -> int:
    """Return the smallest term of node `node_id` (>= 0) that is higher than `current_term` (>= 0)."""
    if current_term == 0:
        return _term(node_id, node_id)
    row, owner = _place(current_term)
    if owner < node_id <= row:
        return _term(row, node_id)
    return _term(max(row + 1, node_id), node_id)


def _term(row: int, column: int) -> int:
    return row * (row + 1) // 2 + column + 1


def _place(term: int) -> tuple[int, int]:
    """Row and column of a term: the inverse of `_term`."""
    row = (math.isqrt(8 * (term - 1) + 1) - 1) // 2
    return row, term - _term(row, 0)
