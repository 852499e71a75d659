"""Example of a user's code: a protocol, an environment, and a script that builds a simulation."""

from typing import Any

from gradysim.protocol.interface import IProtocol, IProvider
from gradysim.protocol.messages.communication import (
    CommunicationCommand,
)
from gradysim.protocol.messages.mobility import (
    MobilityCommand,
)
from gradysim.simulator.handler.communication import CommunicationHandler
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import (
    SimulationBuilder,
    SimulationConfiguration,
    Simulator,
)


class Provider(IProvider):
    """A user's own environment, written against the published interface: it has only a clock."""

    now = 0.0

    def send_communication_command(self, command: CommunicationCommand) -> None: ...

    def send_mobility_command(self, command: MobilityCommand) -> None: ...

    def schedule_timer(self, timer: str, timestamp: float) -> None: ...

    def cancel_timer(self, timer: str) -> None: ...

    def current_time(self) -> float:
        return self.now

    def get_id(self) -> int:
        return 4


def simulation(
    *protocols: type[IProtocol], handlers: tuple[INodeHandler, ...] | None = None, **configuration: Any
) -> Simulator:
    """Return a simulation of nodes at the origin, by default with timers and communication."""
    builder = SimulationBuilder(
        SimulationConfiguration(**{"duration": 10, "execution_logging": False} | configuration)
    )
    for handler in (TimerHandler(), CommunicationHandler()) if handlers is None else handlers:
        builder.add_handler(handler)
    for protocol in protocols:
        builder.add_node(protocol, (0, 0, 0))
    return builder.build()
