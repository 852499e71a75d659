"""Handlers that watch a run, and a protocol that fails in it."""

from gradysim.simulator.handler.interface import INodeHandler

FAILING = """
class Tested(Talker):
    def handle_packet(self, message): raise LookupError("no way out")
"""


class Watching(INodeHandler):
    """Keeps the arguments of its calls."""

    def __init__(self, label="watching"):
        self.label = label
        self.nodes = []
        self.ended = 0

    def get_label(self):
        return self.label

    def inject(self, event_loop):
        self.event_loop = event_loop

    def register_node(self, node):
        self.nodes.append(node)

    def finalize(self):
        self.ended += 1


class Stepping(Watching):
    """Is called after each event."""

    def __init__(self):
        super().__init__()
        self.steps = []

    def after_simulation_step(self, iteration, timestamp):
        self.steps.append((iteration, timestamp))


class Scheduling(Watching):
    """Schedules a callback at a time, from `initialize`."""

    def __init__(self, time, callback):
        super().__init__()
        self.time, self.callback = time, callback

    def initialize(self):
        self.event_loop.schedule_event(self.time, self.callback, "a test")
