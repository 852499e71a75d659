"""Example of a user's code, which `test_typed_user_code.py` checks with mypy."""

import math
from dataclasses import dataclass
from typing import Any

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetVelocityMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.plugin.follow_mobility import MobilityFollowerPlugin, MobilityLeaderPlugin
from gradysim.protocol.plugin.mission_mobility import (
    LoopMission,
    MissionMobilityConfiguration,
    MissionMobilityPlugin,
)
from gradysim.protocol.plugin.raft import RaftConfig, RaftConsensusPlugin, RaftMode, RaftState
from gradysim.protocol.plugin.random_mobility import RandomMobilityConfig, RandomMobilityPlugin
from gradysim.protocol.plugin.statistics import create_statistics, finish_statistics
from gradysim.protocol.position import Position, geo_to_cartesian, squared_distance
from gradysim.simulator.event import EventLoop
from gradysim.simulator.extension.camera import CameraConfiguration, CameraHardware
from gradysim.simulator.extension.radio import Radio
from gradysim.simulator.extension.visualization_controller import VisualizationController
from gradysim.simulator.handler.assertion import (
    AssertionHandler,
    assert_always_true_for_protocol,
    assert_eventually_true_for_simulation,
)
from gradysim.simulator.handler.communication import CommunicationHandler, CommunicationMedium
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.mobility import (
    DynamicVelocityTelemetry,
    MobilityConfiguration,
    MobilityHandler,
)
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.handler.visualization import VisualizationConfiguration, VisualizationHandler
from gradysim.simulator.node import Node
from gradysim.simulator.simulation import (
    PositionScheme,
    SimulationBuilder,
    SimulationConfiguration,
    Simulator,
)


@dataclass
class Sighting:
    place: Position
    time: float


class Scout(IProtocol):
    sightings: list[Sighting]

    def initialize(self) -> None:
        self.sightings = []
        self.mission = MissionMobilityPlugin(
            self, MissionMobilityConfiguration(speed=7, loop_mission=LoopMission.RESTART)
        )
        self.mission.start_mission([(0, 0, 10), (50, 0, 10)])
        self.camera = CameraHardware(self, CameraConfiguration(20, 30, 180, 0))
        self.radio = Radio(self)
        self.radio.set_configuration(transmission_range=200)
        self.viewer = VisualizationController(self)
        config = RaftConfig().add_consensus_variable("target", int).set_raft_mode(RaftMode.CLASSIC)
        self.consensus = RaftConsensusPlugin(config, self)
        self.trip = RandomMobilityPlugin(self, RandomMobilityConfig(x_range=(0, 10)))
        create_statistics(self, "scout", collection_interval=1)
        create_dispatcher(self).register_handle_timer(self.first)
        self.provider.schedule_timer("look", self.provider.current_time() + self.provider.random.random())

    def first(self, protocol: "Scout", timer: str) -> DispatchReturn:
        return DispatchReturn.INTERRUPT if timer == "mine" else DispatchReturn.CONTINUE

    def handle_timer(self, timer: str) -> None:
        for seen in self.camera.take_picture():
            self.sightings.append(Sighting(seen["position"], self.provider.current_time()))
        self.provider.tracked_variables["sightings"] = len(self.sightings)
        self.viewer.paint_node(self.provider.get_id(), (255, 0, 0))
        self.radio.send_communication_command(BroadcastMessageCommand("here"))
        leads = self.consensus.get_current_state() is RaftState.LEADER
        if leads and self.consensus.propose_value("target", 1):
            self.provider.cancel_timer(timer)

    def handle_packet(self, message: str) -> None:
        self.provider.send_communication_command(SendMessageCommand(message.upper(), 0))

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        x, y, z = telemetry.current_position
        if isinstance(telemetry, DynamicVelocityTelemetry):
            self.provider.send_mobility_command(SetVelocityMobilityCommand(*telemetry.current_velocity))
        elif math.sqrt(squared_distance((x, y, z), (0, 0, 0))) > 100:
            home = geo_to_cartesian((0, 0, 0), (1, 1, 1))
            self.provider.send_mobility_command(GotoCoordsMobilityCommand(*home))

    def finish(self) -> None:
        finish_statistics(self)


class Leader(Scout):
    def initialize(self) -> None:
        self.leader = MobilityLeaderPlugin(self)

    def names(self) -> list[str]:
        return [str(number) for number in self.leader.followers]


class Follower(Scout):
    def initialize(self) -> None:
        self.follower = MobilityFollowerPlugin(self)
        self.place: Position | None = self.follower.current_leader_position


class Counter(INodeHandler):
    def __init__(self) -> None:
        self.nodes: list[Node[Any]] = []

    @staticmethod
    def get_label() -> str:
        return "counter"

    def inject(self, event_loop: EventLoop) -> None:
        event_loop.schedule_event(event_loop.current_time + 1, self.count, "count")

    def register_node(self, node: Node[Any]) -> None:
        self.nodes.append(node)

    def count(self) -> None:
        print(len(self.nodes))


@assert_always_true_for_protocol(Scout, "below the ceiling")
def below_the_ceiling(node: Node[Scout]) -> bool:
    return node.position[2] <= 120


@assert_eventually_true_for_simulation("all move")
def all_move(nodes: list[Node[Any]]) -> bool:
    return all(node.position != (0, 0, 0) for node in nodes)


def build() -> Simulator:
    configuration = SimulationConfiguration(duration=60, real_time=False, seed=1)
    builder = SimulationBuilder(configuration)
    builder.add_handler(TimerHandler()).add_handler(MobilityHandler(MobilityConfiguration(update_rate=0.1)))
    builder.add_handler(CommunicationHandler(CommunicationMedium(transmission_range=30)))
    builder.add_handler(VisualizationHandler(VisualizationConfiguration(x_range=(0, 100))))
    builder.add_handler(AssertionHandler([below_the_ceiling, all_move])).add_handler(Counter())
    numbers: list[int] = [builder.add_node(Scout, PositionScheme.random()) for _ in range(3)]
    simulator = builder.build()
    while simulator.step_simulation():
        pass
    scout: Scout = simulator.get_node(numbers[0]).protocol_encapsulator.protocol
    print(scout.sightings)
    return simulator
