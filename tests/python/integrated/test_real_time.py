import pytest

from gradysim.integrated.real_time import TURN_S, RealTimeRun
from gradysim.integrated.run import IntegratedRun, run
from gradysim.simulator.handler.interface import INodeHandler


class Watching(INodeHandler):
    """Logs the wall times of its calls, and may delay the run once."""

    def __init__(self, clock, pause_s=0.0):
        self.clock = clock
        self.pause_s = pause_s
        self.seen = []

    @staticmethod
    def get_label():
        return "watching"

    def inject(self, event_loop):
        self.event_loop = event_loop

    def register_node(self, node):
        pass

    def initialize(self):
        self.schedule()

    def schedule(self):
        self.event_loop.schedule_event(self.event_loop.current_time + 0.25, self.look, "look")

    def look(self):
        self.seen.append((self.event_loop.current_time, self.clock.now - 100.0 - self.paused_s))
        if self.pause_s and len(self.seen) == 3:
            self.clock.now += self.pause_s
            self.paused_s += self.pause_s
        self.schedule()


@pytest.mark.parametrize("factor", [True, 5, 0.5])
def test_events_come_when_they_are_due_by_the_wall_clock(make_scenario, wall_clock, factor):
    handler = Watching(wall_clock)
    result = run(make_scenario(), handlers=[handler], real_time=factor)
    assert len(handler.seen) == 8
    for simulated_s, wall_s in handler.seen:
        assert -1e-9 <= wall_s - simulated_s / factor <= TURN_S + 1e-9
    assert wall_clock.now - 100.0 == pytest.approx(result.sim_time_s / factor)
    assert not result.interrupted


def test_a_pause_is_not_caught_up_on(make_scenario, wall_clock):
    handler = Watching(wall_clock, pause_s=60.0)
    run(make_scenario(), handlers=[handler], real_time=True)
    assert wall_clock.now - 100.0 == pytest.approx(60.0 + 2.05)
    for simulated_s, wall_s in handler.seen:
        assert -1e-9 <= wall_s - simulated_s <= TURN_S + 1e-9


def test_what_is_late_is_caught_up_on(make_scenario, wall_clock):
    class Slow(Watching):
        def look(self):
            super().look()
            if len(self.seen) == 2:
                self.clock.now += 0.6

    handler = Slow(wall_clock)
    run(make_scenario(), handlers=[handler], real_time=True)
    assert wall_clock.now - 100.0 == pytest.approx(2.05)


def test_the_pace_changes_nothing(make_scenario, wall_clock):
    full, paced = run(make_scenario()), run(make_scenario(), real_time=3)
    assert (paced.result_hash, paced.events) == (full.result_hash, full.events)


def test_full_speed_does_not_wait(make_scenario, wall_clock):
    run(make_scenario(), real_time=0)
    assert wall_clock.sleeps == []


def test_a_paced_run_can_be_stopped(make_scenario, wall_clock):
    result = run(make_scenario(), real_time=True, should_stop=lambda: wall_clock.now > 101.0)
    assert result.interrupted
    assert result.sim_time_s == pytest.approx(1.0, abs=2 * TURN_S)


def test_many_events_of_one_turn_are_run_in_portions(wall_clock):
    portions = iter([False, False, True])
    paced = RealTimeRun(lambda until_s, max_events: next(portions), 1.0, lambda: 0.0)
    assert [paced.advance(0.0, 10) for _ in range(3)] == [False, False, True]
    assert wall_clock.sleeps == []


@pytest.mark.parametrize("factor", [-1, float("nan"), "fast"])
def test_what_is_no_factor(make_scenario, factor):
    with pytest.raises(ValueError, match=r"^real_time "):
        IntegratedRun(make_scenario(), real_time=factor)
