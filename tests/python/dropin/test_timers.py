"""Behavior that users rely on, and fixes of the published package: timers."""

from gradysim.encapsulator.interop import ConsequenceType, InteropEncapsulator
from python.dropin.user_code import simulation
from python.quiet_protocol import Quiet


def test_a_callback_may_cancel_timers_of_its_own_name() -> None:
    fired: list[float] = []

    class Once(Quiet):
        def initialize(self) -> None:
            for time in (1, 2, 3):
                self.provider.schedule_timer("tick", time)

        def handle_timer(self, timer: str) -> None:
            fired.append(self.provider.current_time())
            self.provider.cancel_timer("tick")

    simulation(Once).start_simulation()
    assert fired == [1]


def test_a_cancellation_is_for_every_timer_of_that_name_and_of_that_node() -> None:
    fired: list[tuple[int, str]] = []

    class Timers(Quiet):
        def initialize(self) -> None:
            for name in ("a", "b", "a"):
                self.provider.schedule_timer(name, 1)
            if self.provider.get_id() == 0:
                self.provider.cancel_timer("a")
            self.provider.cancel_timer("unknown")

        def handle_timer(self, timer: str) -> None:
            fired.append((self.provider.get_id(), timer))

    simulation(Timers, Timers).start_simulation()
    assert fired == [(0, "b"), (1, "a"), (1, "b"), (1, "a")]


def test_a_host_outside_is_told_of_a_cancellation() -> None:
    class Cancels(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("tick", 1)
            self.provider.cancel_timer("tick")

    host = InteropEncapsulator()
    host.encapsulate(Cancels)
    host.set_id(3)
    host.set_timestamp(0)
    assert host.initialize() == [
        (ConsequenceType.TIMER, ("tick", 1)),
        (ConsequenceType.CANCEL_TIMER, "tick"),
    ]
