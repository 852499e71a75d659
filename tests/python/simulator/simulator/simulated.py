"""Protocols, a handler and simulations for the tests of this directory."""

from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.recording_protocol import RecordingProtocol


class Protocol(RecordingProtocol):
    """Does nothing; records the callbacks of all instances in the class's `calls`: (name, id, *arguments)."""

    calls: list

    def __init__(self): ...

    def note(self, name, *arguments):
        self.calls.append((name, self.provider.get_id(), *arguments))


class Recorder(INodeHandler):
    """A handler that records its calls."""

    def __init__(self, calls):
        self.calls = calls

    @staticmethod
    def get_label():
        return "recorder"

    def inject(self, event_loop):
        self.calls.append(("inject",))

    def register_node(self, node):
        self.calls.append(("register_node", node.id))

    def initialize(self):
        self.calls.append(("handler initialize",))

    def after_simulation_step(self, iteration, timestamp):
        self.calls.append(("after_simulation_step", iteration, timestamp))

    def finalize(self):
        self.calls.append(("finalize",))


def protocol(**methods):
    """Return a protocol class with these callbacks."""
    return type("Tested", (Protocol,), {"calls": [], **methods})


def timers(*times):
    def initialize(self):
        for due in times:
            self.provider.schedule_timer(f"{due:g}", due)

    return protocol(initialize=initialize)


def build(tested, *, nodes=1, handlers=(), **configuration):
    builder = SimulationBuilder(SimulationConfiguration(**configuration))
    for handler in (TimerHandler(), *handlers):
        builder.add_handler(handler)
    for _ in range(nodes):
        builder.add_node(tested, (0, 0, 0))
    return builder.build()


def fired(tested):
    return [call[2] for call in tested.calls if call[0] == "handle_timer"]
