"""The ids of nodes that an argument of a run names."""

import operator
from collections.abc import Iterable


def checked_ids(argument: str, ids: Iterable[int], count: int, expected: str) -> list[int]:
    """Return the ids of some of `count` nodes that `argument` was given, as Python's own integers.

    Raises TypeError, which says what was `expected`, for what is no id, and ValueError for one that is not
    there.
    """
    try:
        checked = [operator.index(node_id) for node_id in ids]
    except TypeError:
        raise TypeError(f"{argument} = {ids!r:.80}: expected {expected}") from None
    for node_id in checked:
        if not 0 <= node_id < count:
            raise ValueError(
                f"{argument}: there is no node {node_id}; expected ids of the {count} nodes, from 0"
            )
    return checked
