"""Hint for nodes at z = 0m under a two-ray model: both rays cancel there, so almost nothing is received."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.schema.keys import PATH_LOSS_EFFECTS, has_radios

if TYPE_CHECKING:
    from gradysim._netsim import MediumConfig


def ground_hint(medium: "MediumConfig", nodes: Sequence[NodeSpec]) -> str:
    """Return advice for those of `nodes` that start on the ground, or ""."""
    low = [node.name for node in nodes if node.initial_position[2] == 0]
    if not has_radios(medium.typename) or medium.path_loss not in PATH_LOSS_EFFECTS["ground"] or not low:
        return ""
    start = "starts" if len(low) == 1 else f"and {len(low) - 1} more start"
    return (
        f"with {medium.path_loss}, a node on the ground hears next to nothing, as both rays cancel, and"
        f" {low[0]} {start} at z = 0m; expected a height, such as `*.{low[0]}.mobility.initialZ = 1.5m`"
    )
