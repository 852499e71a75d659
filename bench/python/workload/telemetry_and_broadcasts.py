"""Workload of prototype_vs_published.py. It runs on any package with gradysim's published API.

Arguments: number of nodes, simulated seconds. Prints a JSON object with the CPU seconds of the run, the
number of callbacks, and the growth of peak memory in the last nine tenths of the simulated time.
"""

import json
import resource
import sys
from time import process_time
from typing import Any

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.simulator.handler.communication import CommunicationHandler, CommunicationMedium
from gradysim.simulator.handler.mobility import MobilityConfiguration, MobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration

SPACING_M = 5.0  # 24 nodes, 12 on each side, are in the range of 60 m


class Node(IProtocol):
    """Broadcasts once a second and counts its callbacks."""

    def initialize(self) -> None:
        self.packets = 0
        self.telemetry = 0
        self.early_memory_kb = 0
        self.provider.schedule_timer("broadcast", self.provider.current_time() + 1)

    def handle_timer(self, timer: str) -> None:
        self.provider.send_communication_command(BroadcastMessageCommand("a message"))
        now = self.provider.current_time()
        self.provider.schedule_timer("broadcast", now + 1)
        if self.early_memory_kb == 0 and now >= duration_s / 10:
            self.early_memory_kb = greatest_memory_kb()

    def handle_packet(self, message: str) -> None:
        self.packets += 1

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.telemetry += 1

    def finish(self) -> None: ...


def greatest_memory_kb() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def measure(nodes: int) -> dict[str, Any]:
    builder = SimulationBuilder(SimulationConfiguration(duration=duration_s, execution_logging=False))
    builder.add_handler(TimerHandler())
    builder.add_handler(CommunicationHandler(CommunicationMedium(transmission_range=60)))
    builder.add_handler(MobilityHandler(MobilityConfiguration(update_rate=0.01)))
    ids = [builder.add_node(Node, (number * SPACING_M, 0, 0)) for number in range(nodes)]
    simulation = builder.build()
    begin = process_time()
    simulation.start_simulation()
    cpu_s = process_time() - begin
    memory_kb = greatest_memory_kb()
    protocols: list[Any] = [simulation.get_node(id).protocol_encapsulator.protocol for id in ids]
    return {
        "cpu_s": cpu_s,
        "callbacks": sum(protocol.packets + protocol.telemetry for protocol in protocols),
        "memory_growth_kb": memory_kb - protocols[0].early_memory_kb,
    }


if __name__ == "__main__":
    duration_s = float(sys.argv[2])
    print(json.dumps(measure(int(sys.argv[1]))))
