"""What users rely on, and where the published package was wrong: the simulator."""

import logging
from pathlib import Path

import pytest

from gradysim.protocol.messages.mobility import (
    SetSpeedMobilityCommand,
)
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import (
    PositionScheme,
    SimulationBuilder,
)
from python.dropin.user_code import simulation
from python.quiet_protocol import Quiet


def test_ids_count_from_zero_in_the_order_of_adding() -> None:
    builder = SimulationBuilder()
    assert [builder.add_node(Quiet, (0, 0, 0)) for _ in range(3)] == [0, 1, 2]


def test_adding_a_handler_returns_the_builder() -> None:
    builder = SimulationBuilder()
    assert builder.add_handler(TimerHandler()) is builder


def test_the_protocol_of_a_node_can_be_reached_from_outside() -> None:
    simulator = simulation(Quiet)
    simulator.start_simulation()
    assert isinstance(simulator.get_node(0).protocol_encapsulator.protocol, Quiet)


def test_a_command_without_its_handler_is_a_warning(caplog: pytest.LogCaptureFixture) -> None:
    class Mover(Quiet):
        def initialize(self) -> None:
            self.provider.send_mobility_command(SetSpeedMobilityCommand(1))

    with caplog.at_level(logging.WARNING):
        simulation(Mover, handlers=(TimerHandler(),)).start_simulation()
    assert "mobility" in caplog.text


def test_simulations_leave_no_log_handlers_behind() -> None:
    before = list(logging.getLogger().handlers)
    for _ in range(3):
        simulation(Quiet, execution_logging=True).start_simulation()
    assert logging.getLogger().handlers == before


def test_lines_of_the_log_say_when_and_where(tmp_path: Path) -> None:
    class Talks(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("", 61.5)

        def handle_timer(self, timer: str) -> None:
            logging.getLogger("mine").info("here")

    file = tmp_path / "run.log"
    simulation(Talks, duration=100, execution_logging=True, log_file=file).start_simulation()
    assert "INFO     [it=0 time=0:01:01.500000 | Talks 0 handle_timer] here" in file.read_text().splitlines()


def test_random_positions_are_in_their_box() -> None:
    x, y, z = PositionScheme.random((1, 2), (3, 4), (5, 6))
    assert 1 <= x <= 2
    assert 3 <= y <= 4
    assert 5 <= z <= 6
