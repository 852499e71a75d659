"""A metric at each level, and what is lost there."""

from collections.abc import Callable

from gradysim.ladder.campaign import Campaign
from gradysim.ladder.ladder import climb, largest_drop
from gradysim.results import compare_pairs, estimate


def test_the_metric_drops_where_frames_overlap(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign("sim-time-limit=1.25s", run_count=2)
    rungs = list(climb(campaign, "nodes[*] heard", range(8)))
    assert [rung.metric and rung.metric.mean for rung in rungs] == [6, 6, 6, 6, 6, 0, 0, 0]
    assert rungs[0].change is None
    assert largest_drop(rungs) is rungs[5]
    assert (rungs[4].loss, rungs[5].loss, rungs[5].loss_ratio) == ("", "receiver_transmitting", 1)


def test_runs_that_fail_count_in_no_mean(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign("sim-time-limit=1.25s", "**.protocol.size=5000", run_count=2)
    radio, real = climb(campaign, "nodes[*] heard", range(4, 6))
    assert radio.metric is not None
    assert not radio.failures
    assert (real.metric, real.change) == (None, None)
    assert [failure.exception for failure in real.failures.values()] == ["CommunicationException"] * 2


def test_messages_that_did_not_fit_into_the_queue_are_a_loss(make_campaign: Callable[..., Campaign]) -> None:
    burst = "**.protocol.interval=0.00001", "sim-time-limit=1.002s", "*.nodes[1..2].protocol.sends=false"
    before, after = climb(make_campaign(*burst, run_count=2), "nodes[*] heard", range(2, 4))
    assert before.loss == ""
    assert after.loss == "queue_overflow"
    assert 0.2 < after.loss_ratio < 0.6


def test_an_event_of_all_runs_is_not_certain(make_campaign: Callable[..., Campaign]) -> None:
    """Two nodes send a beacon each, at the same time. From level 4 on, they collide."""
    campaign = make_campaign("*.numNodes=2", "sim-time-limit=1.05s", run_count=5)
    before, after = climb(campaign, "nodes[*] heard", range(4, 6))
    assert before.metric == estimate([1] * 5, binary=True)
    assert after.metric == estimate([0] * 5, binary=True)
    assert after.change == compare_pairs([1] * 5, [0] * 5, binary=True).difference
