"""Behavior that users rely on, and fixes of the published package: order and time."""

import pytest

from gradysim.simulator.event import EventLoop
from gradysim.simulator.simulation import (
    _ForceFastExecution,
)
from python.dropin.user_code import simulation
from python.quiet_protocol import Quiet


def test_timers_of_one_instant_fire_in_the_order_of_their_setting() -> None:
    fired: list[str] = []

    class Timers(Quiet):
        def initialize(self) -> None:
            for number in range(12):
                self.provider.schedule_timer(str(number), 1)

        def handle_timer(self, timer: str) -> None:
            fired.append(timer)

    simulation(Timers).start_simulation()
    assert fired == [str(number) for number in range(12)]


def test_events_of_one_instant_come_out_in_the_order_in_which_they_went_in() -> None:
    loop = EventLoop()
    for number in range(12):
        loop.schedule_event(1, lambda: None, str(number))
    assert [loop.pop_event().context for _ in range(12)] == [str(number) for number in range(12)]


@pytest.mark.parametrize(("duration", "fired"), [(4.9, []), (5, ["late"])])
def test_nothing_happens_after_the_duration(duration: float, fired: list[str]) -> None:
    seen: list[str] = []

    class Late(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("late", 5)

        def handle_timer(self, timer: str) -> None:
            seen.append(timer)

    simulation(Late, duration=duration).start_simulation()
    assert seen == fired


def test_initialize_and_finish_go_by_id() -> None:
    calls: list[tuple[str, int]] = []

    class Called(Quiet):
        def initialize(self) -> None:
            calls.append(("initialize", self.provider.get_id()))

        def finish(self) -> None:
            calls.append(("finish", self.provider.get_id()))

    simulation(Called, Called).start_simulation()
    assert calls == [("initialize", 0), ("initialize", 1), ("finish", 0), ("finish", 1)]


def test_step_simulation_says_whether_it_goes_on() -> None:
    class Twice(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("", 1)
            self.provider.schedule_timer("", 2)

    simulator = simulation(Twice)
    assert [simulator.step_simulation() for _ in range(3)] == [True, False, False]
    assert simulator.is_simulation_done()


def test_max_iterations_ends_the_run() -> None:
    fired: list[str] = []

    class Timers(Quiet):
        def initialize(self) -> None:
            for number in range(5):
                self.provider.schedule_timer(str(number), number)

        def handle_timer(self, timer: str) -> None:
            fired.append(timer)

    simulation(Timers, max_iterations=2).start_simulation()
    assert fired == ["0", "1"]


def test_real_time_can_be_turned_off_for_tests() -> None:
    class Slow(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("in an hour", 3600)

    simulator = simulation(Slow, duration=None, real_time=True)
    with _ForceFastExecution():
        simulator.start_simulation()
    assert simulator.is_simulation_done()
