"""Quadcopters next to massless nodes."""

import math

import pytest

from gradysim.motion.flight_controller import Airframe
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetSpeedMobilityCommand
from gradysim.simulator.handler.mobility import MasslessMobilityConfiguration, MobilityException
from gradysim.simulator.handler.mobility.quadcopter import QuadcopterMobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import Quiet

TARGET = (50.0, 0.0, 20.0)


class Tested(Quiet):
    def initialize(self):
        self.telemetry = []
        self.provider.schedule_timer("go", 0.205)

    def handle_timer(self, timer):
        self.provider.send_mobility_command(SetSpeedMobilityCommand(5))
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(*TARGET))

    def handle_telemetry(self, telemetry):
        self.telemetry.append(telemetry.current_position)


def simulator(protocol=Tested, duration=15.0, **configured):
    handler = QuadcopterMobilityHandler(None, quadcopters={0: Airframe()})
    handler.configure_node(0, **configured)
    builder = SimulationBuilder(SimulationConfiguration(duration=duration, execution_logging=False, seed=1))
    builder.add_handler(TimerHandler()).add_handler(handler)
    builder.add_node(protocol, (0, 0, 20))
    builder.add_node(protocol, (0, 0, 20))
    return builder.build()


def run(*arguments, **configured):
    made = simulator(*arguments, **configured)
    made.start_simulation()
    return [node.protocol_encapsulator.protocol.telemetry for node in made.nodes]


def test_a_quadcopter_is_late_and_the_other_is_not():
    quadcopter, massless = run()
    assert massless[1019] < TARGET == massless[1020]  # the update at 0.21 s is its first one
    assert quadcopter[1020][0] < 48
    assert quadcopter[-1] == pytest.approx(TARGET, abs=0.1)


def test_a_command_holds_from_the_next_update_on():
    quadcopter, massless = run()
    assert quadcopter[20] == (0, 0, 20) < quadcopter[21]  # 0.21 s, 0.22 s
    assert massless[19] == (0, 0, 20) < massless[20]


def test_an_answer_to_telemetry_holds_at_once():
    class Answering(Tested):
        def handle_telemetry(self, telemetry):
            if len(self.telemetry) == 9:
                self.provider.send_mobility_command(GotoCoordsMobilityCommand(*TARGET))
            super().handle_telemetry(telemetry)

    quadcopter, _ = run(Answering, 0.15)
    assert quadcopter[9] == (0, 0, 20) < quadcopter[10]


def test_telemetry_has_the_error_of_the_position_and_nodes_have_not():
    made = simulator(position_error=1.0)
    made.start_simulation()
    quadcopter, massless = made.nodes
    told = quadcopter.protocol_encapsulator.protocol.telemetry[-1]
    assert 0.1 < math.dist(told, quadcopter.position) < 6
    assert massless.protocol_encapsulator.protocol.telemetry[-1] == massless.position


@pytest.mark.parametrize("wrong", [{"position_error": -1}, {"position_error_time": 0}])
def test_an_error_that_cannot_be_is_refused(wrong):
    with pytest.raises(ValueError, match="position_error"):
        simulator(**wrong)


def test_a_command_that_means_nothing_is_refused():
    made = simulator()
    handler = made.nodes[0].protocol_encapsulator.provider.handlers["mobility"]
    with pytest.raises(MobilityException, match="node 0"):
        handler.handle_command(GotoCoordsMobilityCommand(math.nan, 0, 0), made.nodes[0])


def test_updates_that_are_no_multiple_of_a_step_are_refused():
    with pytest.raises(ValueError, match=r"update_rate is 0\.025 s"):
        QuadcopterMobilityHandler(MasslessMobilityConfiguration(update_rate=0.025), {0: Airframe()})
