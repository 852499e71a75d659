"""Behavior that users rely on, and fixes of the published package: handlers."""

from collections.abc import Callable
from typing import Any

import pytest

from gradysim.protocol.messages.mobility import (
    MobilityCommand,
    SetSpeedMobilityCommand,
)
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.communication import CommunicationHandler
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.mobility import (
    MobilityHandler,
)
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.handler.visualization import VisualizationHandler
from gradysim.simulator.node import Node
from python.dropin.user_code import simulation
from python.quiet_protocol import Quiet


def test_commands_to_the_viewers_wait_in_a_queue() -> None:
    from gradysim.simulator.extension.visualization_controller import VisualizationController

    handler = VisualizationHandler()
    provider: Any = type("Provider", (), {"handlers": {"visualization": handler}})()
    VisualizationController(Quiet.instantiate(provider)).paint_node(0, (255, 0, 0))
    assert handler.command_queue.qsize() == 1
    assert handler.command_queue.get() == {
        "command": "paint_node",
        "payload": {"node_id": 0, "color": (255, 0, 0)},
    }
    assert handler.command_queue.empty()


@pytest.mark.parametrize(
    ("make", "label"),
    [
        (CommunicationHandler, "communication"),
        (TimerHandler, "timer"),
        (MobilityHandler, "mobility"),
        (VisualizationHandler, "visualization"),
    ],
)
def test_handlers_keep_their_labels(make: Callable[[], INodeHandler], label: str) -> None:
    assert make().get_label() == label


def test_a_handler_of_ones_own_may_take_the_place_of_ours() -> None:
    class Still(INodeHandler):
        def __init__(self) -> None:
            self.log: list[str] = []

        @staticmethod
        def get_label() -> str:
            return "mobility"

        def inject(self, event_loop: EventLoop) -> None:
            self.log.append("inject")

        def register_node(self, node: Node[Any]) -> None:
            self.log.append("register")

        def initialize(self) -> None:
            self.log.append("initialize")

        def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
            self.log.append(f"command of {node.id}")

        def after_simulation_step(self, iteration: int, timestamp: float) -> None:
            self.log.append(f"after {iteration} at {timestamp}")

        def finalize(self) -> None:
            self.log.append("finalize")

    class Mover(Quiet):
        def initialize(self) -> None:
            self.provider.send_mobility_command(SetSpeedMobilityCommand(1))
            self.provider.schedule_timer("", 2)

    still = Still()
    simulation(Mover, handlers=(TimerHandler(), MobilityHandler(), still)).start_simulation()
    assert still.log == ["inject", "register", "initialize", "command of 0", "after 0 at 2.0", "finalize"]
