"""What became of frames at single nodes, and of messages from them, told only of those that are asked for.

The engine keeps it for all nodes. As Python's objects, that of a network of thousands would take longer to
make, and more room in a file, than all else in its result.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from gradysim.results.node_ids import checked_ids
from gradysim.results.run_result import NodeResult

if TYPE_CHECKING:
    from gradysim._netsim import Network


def checked_fates_at(fates_at: Iterable[int], count: int) -> frozenset[int]:
    """Return the ids of some of `count` nodes.

    Raises TypeError for what is no id, and ValueError for one that is not there.
    """
    expected = f"ids of nodes, such as [0], or range({count}) for all"
    return frozenset(checked_ids("fates_at", fates_at, count, expected))


def with_fates(
    nodes: tuple[NodeResult, ...], ids: frozenset[int], network: "Network"
) -> tuple[NodeResult, ...]:
    """Return the results of all nodes, those of `ids` with what the network's ledgers say of them."""
    if not ids:
        return nodes
    return tuple(_with_fates(node, nodes, network) if node.id in ids else node for node in nodes)


def _with_fates(node: NodeResult, nodes: tuple[NodeResult, ...], network: "Network") -> NodeResult:
    return replace(
        node,
        frame_fates=_without_zeros(network.frame_fates_at(node.id)),
        interferers={nodes[by].name: copies for by, copies in network.interferers_at(node.id).items()},
        message_fates={
            interface: _without_zeros(kinds)
            for interface, kinds in network.message_fates_from(node.id).items()
        },
    )


def _without_zeros(kinds: Mapping[str, Mapping[str, int]]) -> dict[str, dict[str, int]]:
    met = {kind: {fate: count for fate, count in counts.items() if count} for kind, counts in kinds.items()}
    return {kind: counts for kind, counts in met.items() if counts}
