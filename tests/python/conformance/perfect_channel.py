"""Scenarios in which the network makes no difference, so that both modes must agree exactly."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.position import Position
from gradysim.results.result import RunResult
from gradysim.scenario.errors import Source
from gradysim.scenario.node_spec import InterfaceSpec, NodeSpec
from gradysim.scenario.scenario import CommunicationMediumSpec, Scenario
from gradysim.scenario.schema.values import Setting

MODES: Mapping[str, Callable[[Scenario], RunResult]] = {
    "integrated": gradysim.integrated.run.run,
    "prototype": gradysim.prototype.run.run,
}


@dataclass(frozen=True)
class Case:
    """A network on a perfect channel. Nodes do not move before their protocols move them.

    Attributes:
        positions: One per node, in meters.
        range_m: Range of all radios, in both modes.
        seed: Seed of the run.
        telemetry_interval_s: 0 for none.
        speed_mps: Initial speed of all vehicles.
        duration_s: Duration of the run.
        processing_time_s: Median of the processing time of all computers; 0 for none.
        processing_time_spread: Standard deviation of its logarithm.
    """

    positions: Sequence[Position]
    range_m: float = 50.0
    seed: int = 0
    telemetry_interval_s: float = 0.0
    duration_s: float = 1.0
    speed_mps: float = 10.0
    processing_time_s: float = 0.0
    processing_time_spread: float = 0.0

    def run(self, mode: str, *protocols: type[IProtocol]) -> RunResult:
        """Run it in one of `MODES`. The last protocol also runs on all further nodes."""
        return MODES[mode](self.scenario(*protocols))

    def scenario(self, *protocols: type[IProtocol]) -> Scenario:
        """Return the scenario for both modes."""
        nodes = tuple(
            NodeSpec(
                id=index,
                name=f"nodes[{index}]",
                group="nodes",
                index=index,
                protocol=protocols[min(index, len(protocols) - 1)],
                protocol_parameters={},
                initial_position=position,
                mobility={
                    "telemetry_interval_s": _setting(self.telemetry_interval_s),
                    "speed_mps": _setting(self.speed_mps),
                },
                computer={
                    "processing_time_s": _setting(self.processing_time_s),
                    "processing_time_spread": _setting(self.processing_time_spread),
                },
                wlan=(InterfaceSpec(radio={"communication_range_m": _setting(self.range_m)}),),
            )
            for index, position in enumerate(self.positions)
        )
        return Scenario(
            file=Path("conformance.ini"),
            config="General",
            run_number=0,
            seed=self.seed,
            description="",
            sim_time_limit_s=self.duration_s,
            nodes=nodes,
            medium={"typename": _setting("UnitDiskRadioMedium")},
            communication_medium=CommunicationMediumSpec(transmission_range_m=self.range_m),
            reference_coordinates=(0.0, 0.0, 0.0),
        )


def _setting(value: float | str) -> Setting:
    return Setting(value, Source(Path("conformance.ini"), 1, "key"))
