"""The description of a run at the beginning of its replay."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from gradysim.replay.sink import ReplaySink
from gradysim.replay.tables import EVENT_KINDS, FRAME_KINDS, OUTCOMES
from gradysim.scenario.obstacle_spec import ObstacleSpec
from gradysim.scenario.scenario import Scenario


@dataclass(frozen=True)
class FarLoss:
    """Path loss beyond the range of a node, which the page uses where the record has no power.

    Attributes:
        sensitivity_dbm: Least power that this node receives.
        loss_at_1m_db: Path loss in dB: this plus `exponent` times 10 log10 of the distance in meters.
        exponent: Exponent of the distance.
        is_mean: Whether the loss of a frame may differ, by fading or by antennas that do not face each other.
    """

    sensitivity_dbm: float
    loss_at_1m_db: float
    exponent: float
    is_mean: bool


def describe(
    scenario: Scenario,
    mode: str,
    recorded: frozenset[int] | None,
    ranges_m: Sequence[float | None],
    far_losses: Sequence[FarLoss | None] = (),
) -> dict[str, Any]:
    """Return the description of a scenario for the page: its nodes, its obstacles, its origin.

    `recorded` are the ids of the nodes that are recorded in full; None for all. `ranges_m` are the distances
    at which half of the messages of each node arrive without interference; None if unknown. `far_losses` are
    those of each node, if it has one.
    """
    return {
        "file": scenario.file.name,
        "config": scenario.config,
        "run": scenario.run_number,
        "mode": mode,
        "seed": scenario.seed,
        "iterations": dict(scenario.iterations),
        "description": scenario.description,
        "duration_s": scenario.sim_time_limit_s,
        "ini": _text_of(scenario),
        "recorded": None if recorded is None else sorted(recorded),
        "nodes": [
            {
                "id": node.id,
                "name": node.name,
                "group": node.group,
                "protocol": node.protocol.__name__,
                "range_m": range_m,
                "far_loss": None if far_loss is None else asdict(far_loss),
            }
            for node, range_m, far_loss in zip(
                scenario.nodes, ranges_m, far_losses or [None] * len(ranges_m), strict=True
            )
        ],
        "obstacles": [_obstacle(obstacle) for obstacle in scenario.obstacles],
        "outcomes": OUTCOMES,
        "kinds": FRAME_KINDS,
        "event_kinds": EVENT_KINDS,
    }


def _text_of(scenario: Scenario) -> str:
    try:
        return scenario.file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):  # it was readable before, and the text is only shown
        return ""


def _obstacle(obstacle: ObstacleSpec) -> Mapping[str, Any]:
    """Return its outer footprint and its heights in meters."""
    return {
        "name": obstacle.label or obstacle.name,
        "points": obstacle.rings[0],
        "bottom_m": obstacle.base_m,
        "top_m": obstacle.top_m,
    }


def recorded_nodes(scenario: Scenario, replay: ReplaySink) -> frozenset[int]:
    """Return the ids of the nodes that `replay` records in full."""
    return frozenset(range(len(scenario.nodes))) if replay.recorded is None else replay.recorded
