"""Behavior that users rely on, and fixes of the published package: the simulator."""

import logging
from pathlib import Path
from typing import Any

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


def test_a_loop_around_single_events_works_with_the_names_it_has_in_published_scripts() -> None:
    """Environments of reinforcement learning run a simulation in this way until their episode ends."""
    finished = []

    class Ticking(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("", self.provider.current_time() + 1)

        def handle_timer(self, timer: str) -> None:
            self.initialize()

        def finish(self) -> None:
            finished.append(self.provider.current_time())

    simulator: Any = simulation(Ticking, duration=100)
    simulator._event_loop.schedule_event(0, lambda: None)
    assert simulator._current_timestamp == 0
    times = []
    while simulator._current_timestamp < 3:
        upcoming = simulator._event_loop.peek_event().timestamp
        assert simulator.step_simulation()
        times.append(simulator._current_timestamp)
        assert times[-1] == upcoming
    assert times == [0, 1, 2, 3]
    for _ in range(2):
        simulator._finalize_simulation()
    assert finished == [3]
    assert simulator.step_simulation() is False


def test_a_simulation_can_be_initialised_before_its_first_event() -> None:
    begun = []

    class Begins(Quiet):
        def initialize(self) -> None:
            begun.append(self.provider.get_id())

    simulator: Any = simulation(Begins)
    simulator._initialize_simulation()
    assert begun == [0]
    simulator.start_simulation()
    assert begun == [0]


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
