import json
from contextlib import ExitStack

import pytest
from websockets.sync.client import connect

from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.handler.visualization import VisualizationConfiguration, VisualizationHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import Quiet


class Shown(Quiet):
    """Tracks the seconds since its start."""

    def initialize(self):
        self.handle_timer("second")

    def handle_timer(self, timer):
        now = self.provider.current_time()
        self.provider.tracked_variables["age"] = now
        self.provider.schedule_timer("second", now + 1)


class Viewer:
    """A real WebSocket client."""

    def __init__(self, connection):
        self.connection = connection

    def read(self):
        return json.loads(self.connection.recv(timeout=30))

    def read_until(self, is_wanted):
        while not is_wanted(message := self.read()):
            pass
        return message

    def read_to_the_end(self):
        return [json.loads(message) for message in self.connection]

    def send(self, text):
        self.connection.send(text)


@pytest.fixture
def shown():
    """Return a function that makes shown simulations on a free port; all are stopped at the end."""
    stack = ExitStack()

    class Show:
        def __init__(self, protocol=Shown, **settings):
            configuration = {"host": "127.0.0.1", "port": 0, "update_rate": 0.001} | settings
            self.handler = VisualizationHandler(VisualizationConfiguration(**configuration))
            self.protocol = protocol

        def start(self, **settings):
            configuration = {"execution_logging": False, "duration": 100} | settings
            builder = SimulationBuilder(SimulationConfiguration(**configuration))
            builder.add_handler(TimerHandler()).add_handler(self.handler)
            builder.add_node(self.protocol, (1, 2, 3))
            builder.add_node(self.protocol, (4, 5, 6))
            simulator = builder.build()
            stack.callback(simulator.finalize)
            simulator.step_simulation()
            return simulator

        def viewer(self):
            connection = connect(f"ws://127.0.0.1:{self.handler.port}", open_timeout=30)
            return Viewer(stack.enter_context(connection))

    with stack:
        yield Show
