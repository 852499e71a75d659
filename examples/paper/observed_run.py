"""A run of ZigZag with a handler that takes a sample once a minute, for steps.py.

docs/how-to/write-a-handler.md explains handlers, docs/how-to/repeat-the-paper.md the experiment.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import fmean
from typing import Any

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.results.result import RunResult
from gradysim.scenario import Scenario
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.node import Node

SCENARIOS = Path(__file__).parents[2] / "configs" / "zigzag.ini"
MODES: dict[str, Callable[..., RunResult]] = {
    "prototype": gradysim.prototype.run.run,
    "integrated": gradysim.integrated.run.run,
}


@dataclass(frozen=True)
class Sample:
    """State at one simulated time.

    Attributes:
        time_s: Simulated seconds.
        readings: Readings that had arrived at the ground station.
        nearest_m: Meters from a UAV to the nearest other one, averaged over all UAVs.
    """

    time_s: float
    readings: int
    nearest_m: float


class Observer(INodeHandler):
    """Takes a sample at the start and once a minute."""

    INTERVAL_S = 60.0

    def __init__(self, scenario: Scenario) -> None:
        self.samples: list[Sample] = []
        self._groups = [node.group for node in scenario.nodes]

    @staticmethod
    def get_label() -> str:
        """Return the label of the handler."""
        return "observer"

    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop, and forget the nodes of an earlier run."""
        self._event_loop = event_loop
        self._uavs: list[Node[Any]] = []

    def register_node(self, node: Node[Any]) -> None:
        """Store the observed nodes. Ids follow the order of the scenario."""
        if self._groups[node.id] == "uavs":
            self._uavs.append(node)
        elif self._groups[node.id] == "groundStation":
            self._station = node

    def initialize(self) -> None:
        """Schedule the first sample."""
        self._event_loop.schedule_event(self._event_loop.current_time, self._sample, "observer")

    def _sample(self) -> None:
        now_s = self._event_loop.current_time
        tracked = self._station.protocol_encapsulator.provider.tracked_variables
        self.samples.append(Sample(now_s, tracked["data"], self._nearest_m()))
        self._event_loop.schedule_event(now_s + self.INTERVAL_S, self._sample, "observer")

    def _nearest_m(self) -> float:
        places = [uav.position for uav in self._uavs]
        return fmean(
            min(math.dist(place, other) for j, other in enumerate(places) if j != i)
            for i, place in enumerate(places)
        )


@dataclass(frozen=True)
class ObservedRun:
    """A run and its samples."""

    result: RunResult
    samples: tuple[Sample, ...]


def observed_run(scenario: Scenario, mode: str) -> ObservedRun:
    """Run a scenario in a mode."""
    observer = Observer(scenario)
    result = MODES[mode](scenario, handlers=[observer])
    return ObservedRun(result, tuple(observer.samples))
