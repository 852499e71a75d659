"""What the nodes of a scenario were at the end of a run, whichever mode ran it."""

from collections.abc import Iterable, Mapping
from itertools import repeat

from gradysim.protocol.position import Position
from gradysim.results.node_recorder import NodeRecorder
from gradysim.results.run_result import NodeResult
from gradysim.scenario.scenario import Scenario


def node_results(
    scenario: Scenario,
    ends: Iterable[tuple[Position, Mapping[str, object]]],
    frames_by_bitrate: Iterable[Mapping[int, int]] | None = None,
    recorders: Mapping[int, NodeRecorder] | None = None,
) -> tuple[NodeResult, ...]:
    """Return the results in the order of the ids.

    Args:
        scenario: What was run.
        ends: For each node, in the same order, its position (m) and the variables that it tracked.
        frames_by_bitrate: For each node, in the same order; None for a mode that has no bitrates.
        recorders: What recorded some of the nodes, by their ids.
    """
    recorded = recorders or {}
    rates = repeat({}, len(scenario.nodes)) if frames_by_bitrate is None else frames_by_bitrate
    return tuple(
        NodeResult(
            id=spec.id,
            name=spec.name,
            protocol=spec.protocol.__name__,
            position=position,
            tracked_variables=dict(tracked),
            frames_by_bitrate=frames,
            vectors=recorded[spec.id].vectors() if spec.id in recorded else None,
        )
        for spec, (position, tracked), frames in zip(scenario.nodes, ends, rates, strict=True)
    )
