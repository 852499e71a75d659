"""A clock that runs fast or slow, in both modes."""

import types
from collections.abc import Callable
from functools import partial

import pytest

from gradysim import start
from gradysim.encapsulator.clock import let_clock_drift
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.scenario import Scenario

PROTOCOL = """
class Tested(Quiet):
    def initialize(self):
        self.due = []
        self.provider.schedule_timer("tick", 1.0)

    def handle_timer(self, timer):
        now = self.provider.current_time()
        self.due.append(now)
        self.provider.schedule_timer(timer, now)
        self.provider.cancel_timer(timer)
        self.provider.schedule_timer(timer, now + 1)
"""

MODES = pytest.mark.parametrize("mode", ["prototype", "integrated"])


@MODES
@pytest.mark.parametrize("rate_ppm", [-100_000, -37, 0, 37, 100_000])
def test_timers_follow_the_clock_of_the_node(
    mode: str, rate_ppm: int, make_scenario: Callable[..., Scenario]
) -> None:
    pytest.importorskip("gradysim._netsim")
    scenario = make_scenario(
        PROTOCOL, f"*.uavs[0].clock.oscillator.driftRate={rate_ppm}ppm", "sim-time-limit=5s"
    )
    with start(scenario, mode) as run:
        due = run.node("uavs[0]").protocol.due if run.run_until(4.9) else []
        assert len(due) == int(4.9 * (1 + rate_ppm * 1e-6) + 1e-9)
        assert due == pytest.approx([1.0 * (number + 1) for number in range(len(due))])


@pytest.mark.parametrize("rate", [-0.07, -0.03, 0.07])
def test_a_timer_for_the_present_is_not_moved_into_the_past(rate: float) -> None:
    times = [number / 7 for number in range(1, 1000)]
    due: list[float] = []

    def schedule_timer(timer: str, timestamp: float) -> None:
        due.append(timestamp)

    for time in times:
        provider = types.SimpleNamespace(current_time=partial(float, time), schedule_timer=schedule_timer)
        let_clock_drift(provider, rate)  # type: ignore[arg-type]
        provider.schedule_timer("now", provider.current_time())
    assert any(time * (1 + rate) / (1 + rate) < time for time in times)  # so rounding matters
    assert all(at >= time for at, time in zip(due, times, strict=True))
    assert due == pytest.approx(times)


@MODES
def test_only_that_clock_drifts(mode: str, make_scenario: Callable[..., Scenario]) -> None:
    pytest.importorskip("gradysim._netsim")
    scenario = make_scenario(PROTOCOL, "*.uavs[1].clock.oscillator.driftRate=1000ppm")
    with start(scenario, mode) as run:
        run.run_until(1.0)
        assert run.node("uavs[0]").provider.current_time() == 1.0
        assert run.node("uavs[1]").provider.current_time() == pytest.approx(1.001)
        assert run.time_s == 1.0


def test_a_protocol_of_the_engine_has_no_clock(make_scenario: Callable[..., Scenario]) -> None:
    pytest.importorskip("gradysim._netsim")
    scenario = make_scenario(
        PROTOCOL,
        '*.uavs[0].protocol.typename="SinkProtocol"',
        "*.uavs[0].clock.oscillator.driftRate=1ppm",
    )
    with pytest.raises(ConfigError) as caught:
        start(scenario)
    assert caught.value.key == "*.uavs[0].clock.oscillator.driftRate"
