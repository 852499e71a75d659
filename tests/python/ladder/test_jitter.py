from collections.abc import Callable

import gradysim
from gradysim.ladder.campaign import Campaign
from gradysim.ladder.jitter import Jitter

BEACONS = frozenset({("nodes[*]", "beacon")})
STEP_S = 1e-9
"""Times of the engine are accurate to this."""


def sent(campaign: Campaign, jitter: Jitter | None, index: int = 0) -> list[float]:
    """Return the time at which each node sent its last beacon."""
    scenario = campaign.scenario(campaign.all_effects, index)
    with gradysim.start(scenario) as run:
        if jitter is not None:
            jitter.add_to(run, scenario)
        run.run_until()
    return [float(str(node.tracked_variables["sent"])) for node in run.result().nodes]


def test_timers_are_late_by_up_to_the_longest_delay(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign("sim-time-limit=1.05s")
    assert sent(campaign, None) == [1, 1, 1]
    delays = [time_s - 1 for time_s in sent(campaign, Jitter(BEACONS, 0.02))]
    assert all(0 < delay <= 0.02 for delay in delays)
    assert len(set(delays)) == 3


def test_delays_grow_in_proportion(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign("sim-time-limit=1.05s")
    short, long = (sent(campaign, Jitter(BEACONS, longest_s)) for longest_s in (0.01, 0.04))
    for one, other in zip(short, long, strict=True):
        assert abs(4 * (one - 1) - (other - 1)) < 10 * STEP_S


def test_delays_depend_on_the_seed_of_the_run(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign("sim-time-limit=1.05s", run_count=2)
    jitter = Jitter(BEACONS, 0.02)
    assert sent(campaign, jitter) == sent(campaign, jitter)
    assert sent(campaign, jitter, index=0) != sent(campaign, jitter, index=1)


def test_timers_that_differ_in_numbers_are_one(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign("sim-time-limit=1.05s", "**.protocol.timer=beat-#")
    delays = [time_s - 1 for time_s in sent(campaign, Jitter(frozenset({("nodes[*]", "beat-#")}), 0.02))]
    assert all(0 < delay <= 0.02 for delay in delays)


def test_other_timers_and_groups_stay_on_time(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign("sim-time-limit=1.05s")
    others = frozenset({("nodes[*]", "another"), ("uavs[*]", "beacon"), ("nodes", "beacon")})
    assert sent(campaign, Jitter(others, 0.02)) == [1, 1, 1]


def test_a_single_node_has_the_name_of_its_group(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign("sim-time-limit=1.05s", file='*.base.protocol.class = "protocol.py:Beacon"\n')
    times = sent(campaign, Jitter(frozenset({("base", "beacon")}), 0.02))
    assert times[:3] == [1, 1, 1]
    assert times[3] > 1


def test_draws_of_protocols_stay_the_same(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign("**.protocol.spread=0.05", "sim-time-limit=1.2s", "**.protocol.interval=1")
    without, delayed = sent(campaign, None), sent(campaign, Jitter(BEACONS, 0.01))
    assert all(0 < after - before <= 0.01 for before, after in zip(without, delayed, strict=True))
