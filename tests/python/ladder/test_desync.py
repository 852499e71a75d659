"""The jitter that timers need, found by simulation."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.ladder.campaign import Campaign
from gradysim.ladder.desync import LEAST_GAIN, desynchronize
from gradysim.ladder.desync_words import desync_sentences
from python.ladder.scripted import Scripted

LOCK_STEP = """
class Base(Node):
    def initialize(self):
        self.after("beacon", 1)
    def handle_timer(self, timer):
        self.broadcast("beacon")
        self.after("beacon", 0.1)
        if self.provider.current_time() > 2 and self.fails():
            raise ValueError("broken")
    def fails(self):
        return False

class Other(Base):
    pass
"""


def test_lock_step_timers_need_little_jitter(make_campaign: Callable[..., Campaign]) -> None:
    found = desynchronize(make_campaign(run_count=2))
    assert found.timers == (("nodes[*]", "beacon"),)
    assert found.jitter_s is not None
    assert 0 < found.jitter_s < 0.01
    assert (found.trials[0].delivery, found.trials[0].clashes) == (0, 1)
    assert max(trial.delivery for trial in found.trials) > 0.99
    assert found.run_count == 2 * (1 + len(found.trials))
    assert {trial.metric for trial in found.trials} == {None}
    assert found.failures == {}


def test_a_metric_is_averaged_for_each_jitter(make_campaign: Callable[..., Campaign]) -> None:
    found = desynchronize(make_campaign(), metric="nodes[*] heard")
    assert found.trials[0].metric == 0
    assert found.trials[-1].metric is not None
    assert found.trials[-1].metric > 60


def test_answers_get_no_jitter(make_campaign: Callable[..., Campaign]) -> None:
    poll = "*.numNodes=20", "*.nodes[0].protocol.sends=true", "*.nodes[*].protocol.sends=false"
    found = desynchronize(make_campaign(*poll, "*.nodes[*].protocol.answers=true"))
    assert (found.timers, found.jitter_s) == ((), None)
    assert "handle_packet of nodes[*]" in "\n".join(desync_sentences(found))


def test_timers_of_the_engine_get_no_jitter(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign(
        "*.nodes[*].protocol.typename=BeaconProtocol", "*.nodes[*].protocol.interval=0.1s"
    )
    found = desynchronize(campaign)
    assert found.diagnosis.patterns[0].verdict == "synchronized"
    assert found.trials == ()


def test_hidden_timers_that_drift_past_each_other_need_no_jitter(
    make_campaign: Callable[..., Campaign],
) -> None:
    hidden = "*.nodes[*].mobility.lineStepX=70m", "*.nodes[1].protocol.sends=false", "sim-time-limit=30s"
    periods = "*.nodes[0].protocol.interval=0.02", "*.nodes[2].protocol.interval=0.02002"
    found = desynchronize(make_campaign(*hidden, *periods, "**.protocol.size=1000"))
    assert found.diagnosis.patterns[0].verdict == "hidden and drifting"
    assert found.jitter_s is None
    assert "RTS" in "\n".join(desync_sentences(found))


def test_timers_that_differ_in_numbers_get_one_jitter(make_campaign: Callable[..., Campaign]) -> None:
    found = desynchronize(make_campaign("**.protocol.timer=beat-#"))
    assert found.timers == (("nodes[*]", "beat-#"),)
    assert found.jitter_s
    assert '"beat-#" of nodes[*] ' in "\n".join(desync_sentences(found))


def test_a_jitter_that_saves_little_is_not_recommended(make_campaign: Callable[..., Campaign]) -> None:
    """Frames of hidden nodes fill 44 % of the period. At random times, most of them still meet."""
    hidden = "*.nodes[*].mobility.lineStepX=70m", "*.nodes[1].protocol.sends=false"
    long = "**.protocol.size=1400", "**.protocol.interval=0.002", "*.nodes[*].wlan[*].bitrate=18Mbps"
    found = desynchronize(make_campaign(*hidden, *long, "sim-time-limit=2s"))
    assert found.diagnosis.patterns[0].verdict == "synchronized"
    least = min(trial.clashes for trial in found.trials)
    assert (1 - LEAST_GAIN) * found.trials[0].clashes < least < found.trials[0].clashes
    assert found.jitter_s == 0
    assert f" {found.trials[0].clashes:.1%} " in "\n".join(desync_sentences(found))


def test_a_timer_that_fires_once_gets_jitters_by_the_length_of_its_frame(
    make_campaign: Callable[..., Campaign],
) -> None:
    found = desynchronize(make_campaign("**.protocol.interval=100"))
    assert found.diagnosis.patterns[0].period_s == 0
    assert found.jitter_s
    assert found.trials[-1].jitter_s == pytest.approx(100 * found.diagnosis.airtime_s, rel=0.1)
    assert "every" not in "\n".join(desync_sentences(found))


def test_all_runs_are_read(make_campaign: Callable[..., Campaign]) -> None:
    """Each node draws one of two slots. In some runs, all draws differ or are equal."""
    drawn = "**.protocol.interval=100", "*.nodes[2].protocol.sends=false", "**.protocol.spread=0.001"
    alone = [desynchronize(make_campaign(*drawn, f"seed-set={seed}")).diagnosis for seed in range(6)]
    together = desynchronize(make_campaign(*drawn, "seed-set=${repetition}", run_count=6)).diagnosis
    assert together.clashes == sum(each.clashes for each in alone)
    assert together.receptions == sum(each.receptions for each in alone)


def test_a_run_that_fails_does_not_end_the_analysis(tmp_path: Path) -> None:
    """Each beacon after 2 s fails in 5 % of the cases."""
    fails = LOCK_STEP.replace("return False", "return self.provider.random.random() < 0.05")
    found = desynchronize(Scripted(tmp_path, fails, run_count=4).campaign)
    assert 0 < len(found.failures) < 4
    failure = next(iter(found.failures.values()))
    assert (failure.exception, failure.message) == ("ValueError", "broken")
    assert failure.where.startswith("in handle_timer ")
    assert found.timers == (("base", "beacon"), ("other", "beacon"))
    assert found.jitter_s
    index = next(iter(found.failures))
    assert f"Run {index} " in "\n".join(desync_sentences(found))


def test_runs_that_all_fail_are_diagnosed_up_to_then(tmp_path: Path) -> None:
    found = desynchronize(Scripted(tmp_path, LOCK_STEP.replace("False", "True"), run_count=2).campaign)
    assert set(found.failures) == {0, 1}
    assert found.diagnosis.clashes > 0
    assert next(desync_sentences(found)).startswith("All 2 ")


def test_runs_that_fail_at_once_have_no_clashes(make_campaign: Callable[..., Campaign]) -> None:
    found = desynchronize(make_campaign("**.protocol.first=-1", run_count=2))
    assert set(found.failures) == {0, 1}
    assert found.diagnosis.receptions == 0


def test_a_failure_with_jitter_is_named(
    make_campaign: Callable[..., Campaign], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*args: object) -> None:
        raise ValueError("broken")

    monkeypatch.setattr("gradysim.ladder.jitter.Jitter.add_to", fail)
    found = desynchronize(make_campaign())
    assert found.failures == {}
    assert [list(trial.failures) for trial in found.trials] == [[0]] * len(found.trials)
    assert "ValueError: broken" in "\n".join(desync_sentences(found))
