"""The jitter that timers need, found by simulation."""

from collections.abc import Callable

import pytest

from gradysim.ladder.campaign import Campaign
from gradysim.ladder.desync import desynchronize
from gradysim.ladder.desync_words import desync_sentences


def test_lock_step_timers_need_little_jitter(make_campaign: Callable[..., Campaign]) -> None:
    found = desynchronize(make_campaign(run_count=2))
    assert found.timers == (("nodes[*]", "beacon"),)
    assert found.jitter_s is not None
    assert 0 < found.jitter_s < 0.01
    assert found.trials[0].delivery == 0
    assert max(trial.delivery for trial in found.trials) > 0.99
    assert found.run_count == 1 + 2 * len(found.trials)
    assert {trial.metric for trial in found.trials} == {None}


def test_a_metric_is_averaged_for_each_jitter(make_campaign: Callable[..., Campaign]) -> None:
    found = desynchronize(make_campaign(), metric="nodes[*] heard")
    assert found.trials[0].metric == 0
    assert found.trials[-1].metric is not None
    assert found.trials[-1].metric > 60


def test_answers_get_no_jitter(make_campaign: Callable[..., Campaign]) -> None:
    poll = "*.numNodes=20", "*.nodes[0].protocol.sends=true", "*.nodes[*].protocol.sends=false"
    found = desynchronize(make_campaign(*poll, "*.nodes[*].protocol.answers=true"))
    assert (found.timers, found.jitter_s) == ((), None)
    assert "handle_packet of nodes[*]: send together" in "\n".join(desync_sentences(found))


def test_timers_of_the_engine_get_no_jitter(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign(
        "*.nodes[*].protocol.typename=BeaconProtocol", "*.nodes[*].protocol.interval=0.1s"
    )
    found = desynchronize(campaign)
    assert found.diagnosis.patterns[0].verdict == "synchronized"
    assert found.trials == ()


def test_hidden_timers_that_drift_past_each_other_do_not_need_jitter(
    make_campaign: Callable[..., Campaign],
) -> None:
    hidden = "*.nodes[*].mobility.lineStepX=70m", "*.nodes[1].protocol.sends=false", "sim-time-limit=30s"
    periods = "*.nodes[0].protocol.interval=0.02", "*.nodes[2].protocol.interval=0.02002"
    found = desynchronize(make_campaign(*hidden, *periods, "**.protocol.size=1000"))
    assert found.diagnosis.patterns[0].verdict == "hidden and drifting"
    assert found.jitter_s is None
    assert "agree on a clock, or use RTS and CTS" in "\n".join(desync_sentences(found))


def test_a_run_with_jitter_that_fails_is_reported(
    make_campaign: Callable[..., Campaign], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*args: object) -> None:
        raise ValueError("broken")

    monkeypatch.setattr("gradysim.ladder.jitter.Jitter.add_to", fail)
    with pytest.raises(RuntimeError, match="jitter of 0 s, run 0: ValueError: broken"):
        desynchronize(make_campaign())
