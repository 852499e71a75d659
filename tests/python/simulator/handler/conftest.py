import pytest

from gradysim.simulator.event import EventLoop
from gradysim.simulator.node import Node


class Recorder:
    """Replaces a protocol: records its callbacks, with their times."""

    def __init__(self, loop):
        self.loop = loop
        self.calls = []

    def handle_packet(self, message):
        self.calls.append((self.loop.current_time, message))

    def handle_timer(self, timer):
        self.calls.append((self.loop.current_time, timer))

    def handle_telemetry(self, telemetry):
        self.calls.append((self.loop.current_time, telemetry.current_position))


class World:
    """An event loop with nodes that are wired by hand, as in a user's handler test."""

    def __init__(self):
        self.loop = EventLoop()

    def node(self, identifier, position=(0.0, 0.0, 0.0), handler=None):
        node = Node()
        node.id = identifier
        node.position = position
        node.protocol_encapsulator = Recorder(self.loop)
        if handler is not None:
            handler.register_node(node)
        return node

    def run(self, until=float("inf")):
        """Run the events up to a time; return their number."""
        count = 0
        while (event := self.loop.peek_event()) is not None and event.timestamp <= until:
            self.loop.pop_event().callback()
            count += 1
        return count


@pytest.fixture
def world():
    return World()


@pytest.fixture(scope="module")
def new_world():
    """Return a function that makes worlds: one for each example of a property."""
    return World
