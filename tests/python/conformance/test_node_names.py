"""Nodes have names, which protocols use instead of ids, in both modes."""

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import gradysim as gs
from gradysim.encapsulator import validation
from gradysim.encapsulator.validation import id_of_name
from gradysim.protocol.errors import CommunicationException
from gradysim.protocol.messages.communication import SendMessageCommand
from gradysim.results.result import RunResult
from gradysim.simulator.handler.communication import CommunicationHandler
from gradysim.simulator.handler.mobility import MobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import QUIET, Quiet

pytest.importorskip("gradysim._netsim")

MODES = pytest.mark.parametrize("mode", ["prototype", "integrated"])

PROTOCOL = f"""{QUIET}
from gradysim.protocol.messages.communication import CommunicationCommand, SendMessageCommand

class Sender(Quiet):
    to: str = "base"
    asks: bool = True
    def initialize(self):
        self.provider.schedule_timer("send", 0.1 * (1 + self.provider.get_id()))
    def handle_timer(self, timer):
        if self.asks:
            self.provider.tracked_variables["id"] = self.provider.id_of(self.to)
        self.provider.send_communication_command(SendMessageCommand("hello", self.to))
    def handle_packet(self, message):
        self.provider.tracked_variables["got"] = message

class Early(Sender):
    def __init__(self):
        self.provider.get_id()
"""

INI = """[General]
sim-time-limit = 1s
*.numUavs = 3
*.uavs[*].protocol.class = "sender.py:Sender"
*.base.protocol.class = "sender.py:Sender"
*.base.protocol.to = "uavs[1]"
*.uavs[*].mobility.lineStepX = 10m
*.base.mobility.initialY = 10m
"""

Run = Callable[..., RunResult]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """`run(mode, *overrides)`: the result of three senders and a base."""
    (tmp_path / "sender.py").write_text(PROTOCOL)
    (tmp_path / "names.ini").write_text(INI)

    def run_with(mode: str, *overrides: str, replay: str = "") -> RunResult:
        file = tmp_path / "names.ini"
        return gs.run(file, runs=0, mode=mode, overrides=overrides, replay=replay or ())

    return run_with


@MODES
def test_a_message_goes_to_the_node_of_that_name(run: Run, mode: str) -> None:
    tracked = {node.name: node.tracked_variables for node in run(mode).nodes}
    assert tracked == {
        "uavs[0]": {"id": 3},
        "uavs[1]": {"id": 3, "got": "hello"},
        "uavs[2]": {"id": 3},
        "base": {"id": 1, "got": "hello"},
    }


@MODES
def test_a_replay_has_messages_to_names(run: Run, mode: str) -> None:
    assert run(mode, replay="all").replay_page


@MODES
@pytest.mark.parametrize("asks", ["true", "false"])
def test_an_unknown_name_is_an_error_with_the_nearest_one(run: Run, mode: str, asks: str) -> None:
    settings = ('*.uavs[0].protocol.to = "bse"', f"*.uavs[0].protocol.asks = {asks}")
    with pytest.raises(CommunicationException, match=r"'bse'; .* 'base'\?"):
        run(mode, *settings)


@pytest.mark.parametrize("name", [3, None, [], b"base"])
def test_a_name_is_a_str(name: Any) -> None:
    with pytest.raises(CommunicationException, match=r" str\b"):
        id_of_name(name, {"base": 0})
    with pytest.raises(TypeError, match=r" str\b"):
        SimulationBuilder(SimulationConfiguration()).add_node(Quiet, (0, 0, 0), name)


def test_the_nearest_name_is_looked_for_only_if_the_message_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(validation, "get_close_matches", lambda *arguments, n: ["nearest"])
    with pytest.raises(CommunicationException) as raised:
        id_of_name("bse", {"base": 0})
    monkeypatch.undo()
    assert "'base'?" in str(raised.value)
    assert str(pickle.loads(pickle.dumps(raised.value))) == str(raised.value)


def test_a_script_names_its_nodes() -> None:
    class Sender(Quiet):
        def initialize(self) -> None:
            if self.provider.get_id() == 0:
                self.provider.send_communication_command(SendMessageCommand("hello", "base"))

        def handle_packet(self, message: str) -> None:
            self.provider.tracked_variables["got"] = message

    builder = SimulationBuilder(SimulationConfiguration(duration=1, execution_logging=False))
    builder.add_handler(CommunicationHandler()).add_handler(TimerHandler()).add_handler(MobilityHandler())
    for name in ("", "other", "base"):
        builder.add_node(Sender, (0, 0, 0), name)
    with pytest.raises(ValueError, match="'base'"):
        builder.add_node(Sender, (0, 0, 0), "base")
    simulator = builder.build()
    simulator.start_simulation()
    tracked = [node.protocol_encapsulator.provider.tracked_variables for node in simulator.nodes]
    assert tracked == [{}, {}, {"got": "hello"}]


@MODES
def test_a_constructor_that_uses_its_provider_is_told_where_to_use_it(run: Run, mode: str) -> None:
    with pytest.raises(AttributeError) as raised:
        run(mode, '*.uavs[0].protocol.class = "sender.py:Early"')
    assert raised.value.__notes__[0].endswith("`initialize`")
