"""Protocols written for gradys-embedded run in both modes and in .ini files without changes."""

import math
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.protocol.position import geo_to_cartesian
from gradysim.results.result import NodeResult, RunResult
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.errors import ConfigError

PROTOCOLS = """
from gradys_embedded.protocol.interface import IProtocol
from gradys_embedded.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradys_embedded.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    SetSpeedMobilityCommand,
)
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin


class Drone(IProtocol):
    speed: float = 1.0

    def initialize(self):
        self.provider.tracked_variables["heard"] = []
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(100, 0, 10))
        self.provider.send_mobility_command(SetSpeedMobilityCommand(self.speed))
        self.provider.schedule_timer("greet", 0.5)

    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))

    def handle_packet(self, message):
        self.provider.tracked_variables["heard"] += [message]

    def handle_telemetry(self, telemetry):
        self.provider.tracked_variables["x"] = telemetry.current_position[0]

    def finish(self):
        self.provider.tracked_variables["finished"] = True


class Answers(Drone):
    def initialize(self):
        self.provider.tracked_variables["heard"] = []
        self.provider.send_mobility_command(GotoGeoCoordsMobilityCommand(0.001, 0, 10))

    def handle_packet(self, message):
        super().handle_packet(message)
        self.provider.send_communication_command(SendMessageCommand("welcome", 0))


class OnMission(Drone):
    def initialize(self):
        self.mission = MissionMobilityPlugin(self)
        self.mission.start_mission([(5, 0, 10), (5, 5, 10)])


class Incomplete(IProtocol):
    def initialize(self): ...
"""

INI = """
sim-time-limit = 4s
*.numDrones = 1
*.numAnswerers = 1
*.drones[*].protocol.class = "protocols.py:Drone"
*.answerers[*].protocol.class = "protocols.py:Answers"
*.drones[0].mobility.initialX = 0m
*.answerers[0].mobility.initialX = 20m
*.*[*].mobility.initialY = 0m
*.*[*].mobility.initialZ = 10m
*.radioMedium.typename = "UnitDiskRadioMedium"
"""

MODES: dict[str, Callable[[Scenario], RunResult]] = {
    "prototype": gradysim.prototype.run.run,
    "integrated": gradysim.integrated.run.run,
}


@pytest.fixture(autouse=True)
def stand_in(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("embedded")))
    yield
    for name in [name for name in sys.modules if name.split(".")[0] == "gradys_embedded"]:
        del sys.modules[name]


def scenario(folder: Path, *lines: str) -> Scenario:
    (folder / "protocols.py").write_text(PROTOCOLS, encoding="utf-8")
    (folder / "omnetpp.ini").write_text("\n".join(["[General]", *lines, INI]), encoding="utf-8")
    (loaded,) = load_scenarios(folder / "omnetpp.ini")
    return loaded


def nodes_of(run: RunResult) -> tuple[NodeResult, NodeResult]:
    drone, answerer = run.nodes
    return drone, answerer


@pytest.mark.parametrize("mode", MODES)
def test_messages_timers_and_finish(mode: str, tmp_path: Path) -> None:
    drone, answerer = nodes_of(MODES[mode](scenario(tmp_path)))
    assert drone.tracked_variables["heard"] == ["welcome"]
    assert answerer.tracked_variables["heard"] == ["hello"]
    assert drone.tracked_variables["finished"] is True


@pytest.mark.parametrize("mode", MODES)
def test_mobility_commands_and_telemetry(mode: str, tmp_path: Path) -> None:
    drone, answerer = nodes_of(MODES[mode](scenario(tmp_path)))
    assert drone.position == pytest.approx((4, 0, 10), abs=0.05)  # 1 m/s for 4 s
    assert drone.tracked_variables["x"] == pytest.approx(4, abs=0.05)
    target = geo_to_cartesian((0, 0, 0), (0.001, 0, 10))
    assert math.dist(answerer.position, target) == pytest.approx(math.dist((20, 0, 10), target) - 40, abs=0.2)


@pytest.mark.parametrize("mode", MODES)
def test_parameters_of_ini_files(mode: str, tmp_path: Path) -> None:
    drone, _ = nodes_of(MODES[mode](scenario(tmp_path, "*.drones[*].protocol.speed = 3mps")))
    assert drone.position == pytest.approx((12, 0, 10), abs=0.1)


@pytest.mark.parametrize("mode", MODES)
def test_plugins_of_gradysim(mode: str, tmp_path: Path) -> None:
    on_mission = scenario(tmp_path, '*.drones[0].protocol.class = "protocols.py:OnMission"')
    drone, _ = nodes_of(MODES[mode](on_mission))
    assert drone.position == pytest.approx((5, 5, 10), abs=0.5)


@pytest.mark.parametrize("name", ["IProtocol", "Incomplete"])
def test_the_interface_and_incomplete_protocols_are_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(ConfigError):
        scenario(tmp_path, f'*.drones[0].protocol.class = "protocols.py:{name}"')
