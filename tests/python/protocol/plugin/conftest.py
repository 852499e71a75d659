"""Fixtures of the plugins: a provider that records, and short runs in both modes."""

from typing import NamedTuple

import pytest

from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.protocol.interface import IProvider
from gradysim.protocol.messages.mobility import MobilityCommandType
from gradysim.scenario import load_scenarios
from gradysim.simulator.handler.communication import CommunicationHandler, CommunicationMedium
from gradysim.simulator.handler.mobility import MobilityConfiguration, MobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import QUIET
from python.recording_protocol import RecordingProtocol


class RecordingProvider(IProvider):
    """Records its calls; time advances only by `pass_time`."""

    def __init__(self, node_id=0, seed=0):
        self.node_id = node_id
        self.now = 0.0
        self.commands = []
        self.sent = []
        self.timers = []
        self.tracked_variables = {}
        self._stream = RandomStream(seed, node_id, Purpose.PROTOCOL)

    def send_communication_command(self, command):
        self.sent.append(command)

    def send_mobility_command(self, command):
        self.commands.append(command)

    def schedule_timer(self, timer, timestamp):
        assert timestamp >= self.now, "a timer in the past"
        self.timers.append((timestamp, timer))

    def cancel_timer(self, timer):
        self.timers = [pending for pending in self.timers if pending[1] != timer]

    def current_time(self):
        return self.now

    def get_id(self):
        return self.node_id

    @property
    def random(self):
        return self._stream

    def pass_time(self, protocol, until):
        """Fire the timers that are due up to that time, in order."""
        while self.timers and min(self.timers)[0] <= until:
            due = min(self.timers)
            self.timers.remove(due)
            self.now = due[0]
            protocol.handle_timer(due[1])
        self.now = until

    @property
    def targets(self):
        """Return the targets of the vehicle, in order."""
        return [
            (command.param_1, command.param_2, command.param_3)
            for command in self.commands
            if command.command_type == MobilityCommandType.GOTO_COORDS
        ]

    @property
    def speeds(self):
        return [
            command.param_1
            for command in self.commands
            if command.command_type == MobilityCommandType.SET_SPEED
        ]


@pytest.fixture(scope="session")
def make_protocol():
    """`make_protocol(node_id=0, seed=0)`: a recording protocol on a recording provider."""
    return lambda **arguments: RecordingProtocol.instantiate(RecordingProvider(**arguments))


@pytest.fixture
def protocol(make_protocol):
    return make_protocol()


class Outcome(NamedTuple):
    """Final state of a node."""

    position: tuple[float, float, float]
    tracked_variables: dict[str, object]


def build(configuration, *protocols):
    """Return a simulation of these protocols like a script's, all at the origin and in range."""
    builder = SimulationBuilder(configuration)
    builder.add_handler(CommunicationHandler(CommunicationMedium(transmission_range=1000)))
    builder.add_handler(TimerHandler())
    builder.add_handler(MobilityHandler(MobilityConfiguration()))
    for protocol in protocols:
        builder.add_node(protocol, (0.0, 0.0, 0.0))
    return builder.build()


def prototype(scenario):
    simulator = build(
        SimulationConfiguration(
            duration=scenario.sim_time_limit_s, seed=scenario.seed, execution_logging=False
        ),
        *(node.protocol for node in scenario.nodes),
    )
    simulator.start_simulation()
    nodes = [simulator.get_node(node.id) for node in scenario.nodes]
    return [Outcome(node.position, node.protocol_encapsulator.provider.tracked_variables) for node in nodes]


def integrated(scenario):
    pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")
    from gradysim.integrated.run import run

    return [Outcome(node.position, node.tracked_variables) for node in run(scenario).nodes]


@pytest.fixture
def make_scenario(tmp_path):
    """`make_scenario(python, *settings)`: the protocols of `python` on a channel without losses."""

    def make(python, *settings):
        (tmp_path / "protocols.py").write_text(f"{QUIET}\n{python}\n", encoding="utf-8")
        lines = ["[General]", *settings, '*.radioMedium.typename = "UnitDiskRadioMedium"']
        (tmp_path / "test.ini").write_text("\n".join(lines), encoding="utf-8")
        (scenario,) = load_scenarios(tmp_path / "test.ini")
        return scenario

    return make


@pytest.fixture(params=[prototype, integrated], ids=["prototype", "integrated"])
def run_mode(request):
    """`run_mode(scenario)`: run it in one of the modes; return the `Outcome` of each node."""
    return request.param


@pytest.fixture
def build_simulation():
    """`build_simulation(configuration, *protocols)`: a simulator of nodes at the origin, all in range."""
    return build


@pytest.fixture
def run_prototype():
    """`run_prototype(scenario)`: the `Outcome` of each node."""
    return prototype


@pytest.fixture
def run_integrated():
    """`run_integrated(scenario)`: the `Outcome` of each node."""
    return integrated
