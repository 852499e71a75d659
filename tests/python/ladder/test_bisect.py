"""Which level breaks a protocol."""

from collections import Counter
from collections.abc import Callable

import pytest

from gradysim.ladder.assertion import Assertion
from gradysim.ladder.bisect import Bisection, Tally
from gradysim.ladder.campaign import Campaign
from gradysim.ladder.words import verdict_sentences
from gradysim.scenario.errors import ConfigError
from python.ladder.runs_by_chance import RunsByChance

SHORT = "sim-time-limit=1.25s"
"""Three beacons of each node: at most 6 heard by each."""
WORKS = Assertion.parse("works >= 1")


@pytest.fixture
def bisection_of(make_campaign: Callable[..., Campaign]) -> Callable[..., Bisection]:
    """`bisection_of("nodes[*] heard >= 6", *settings)`: not yet run."""

    def bisection(assertion: str, *settings: str, max_runs: int = 200) -> Bisection:
        campaign = make_campaign(SHORT, *settings, run_count=max_runs)
        return Bisection(campaign, Assertion.parse(assertion), max_runs=max_runs)

    return bisection


def test_the_level_that_breaks_lock_step_timers(bisection_of: Callable[..., Bisection]) -> None:
    bisection = bisection_of("nodes[*] heard >= 6")
    verdict = bisection.find()
    assert (verdict.works, verdict.fails, verdict.is_sure) == (4, 5, True)
    assert verdict.smallest == ("airtime", "interference")
    assert verdict.index == 0
    assert verdict.run_count == bisection.run_count < 120


def test_all_effects_that_are_needed_are_named(bisection_of: Callable[..., Bisection]) -> None:
    """A stronger frame survives a collision: without collisions, or without capture, nothing is missing."""
    candidates = "*.nodes[2].mobility.initialX=5m", "*.nodes[1].mobility.initialX=90m"
    bisection = bisection_of("nodes[*] heard != 1", *candidates, "*.nodes[2].protocol.sends=false")
    verdict = bisection.find()
    assert (verdict.works, verdict.fails) == (5, 6)
    assert verdict.smallest == ("airtime", "radio", "interference", "capture")


def test_hidden_nodes_need_their_range(bisection_of: Callable[..., Bisection]) -> None:
    """The outer two do not hear each other, so that they send into each other at the one between them."""
    hidden = (
        "*.nodes[*].mobility.lineStepX=90m",
        "*.nodes[1].protocol.sends=false",
        "*.nodes[2].protocol.first=1.0001",
    )
    bisection = bisection_of("nodes[*] heard >= 2", *hidden, "**.protocol.size=500")
    verdict = bisection.find()
    assert verdict.fails == 5
    assert verdict.smallest == ("range", "airtime", "interference")


def test_a_protocol_that_survives_all_levels_uses_the_budget(bisection_of: Callable[..., Bisection]) -> None:
    bisection = bisection_of("nodes[*] heard >= 6", "**.protocol.step=0.01", max_runs=104)
    verdict = bisection.find()
    assert (verdict.works, verdict.fails, verdict.run_count) == (7, None, 104)
    at_top = bisection.at_level(7)
    assert (at_top.held, at_top.run_count) == (22, 22)
    assert at_top.most_failures(0.95) == pytest.approx(1 - 0.05 ** (1 / 22))


def test_a_protocol_that_never_works(bisection_of: Callable[..., Bisection]) -> None:
    verdict = bisection_of("nodes[*] heard >= 7").find()
    assert (verdict.works, verdict.fails, verdict.run_count) == (None, 0, 80)


def test_an_assertion_that_holds_at_the_last_level_only(bisection_of: Callable[..., Bisection]) -> None:
    bisection = bisection_of("nodes[*] heard <= 0")
    verdict = bisection.find()
    assert (verdict.works, verdict.fails) == (None, 0)
    text = "\n".join(verdict_sentences(bisection, verdict))
    assert " 0 of 10 " in text
    assert "7 noise (10 of 10 " in text


def test_a_flaw_that_a_higher_level_hides_is_found() -> None:
    verdict = Bisection(RunsByChance([0, 0, 0, 1, 0, 0], 1), WORKS).find()
    assert (verdict.works, verdict.fails, verdict.is_sure) == (2, 3, True)


def test_each_level_is_run() -> None:
    runs = RunsByChance([0] * 8, 1)
    Bisection(runs, WORKS, max_runs=100).find()
    counts = Counter(effects for effects, _ in runs.submitted)
    assert set(counts) == {runs.effects_up_to(level) for level in range(8)}
    assert min(counts.values()) >= 10


def test_no_run_is_done_twice_and_the_budget_is_kept() -> None:
    for failing in ([0] * 8, [0] * 5 + [0.1] * 3, [0.3] * 8):
        runs = RunsByChance(failing, 1)
        verdict = Bisection(runs, WORKS).find()
        assert len(runs.submitted) == len(set(runs.submitted)) == verdict.run_count <= 400


def test_failures_too_rare_to_be_located_are_reported() -> None:
    verdict = Bisection(RunsByChance([0] * 5 + [0.02] * 3, 3), WORKS).find()
    assert (verdict.fails, verdict.is_sure) == (5, False)
    assert verdict.index is not None


def test_levels_that_do_not_differ_are_undecided() -> None:
    verdict = Bisection(RunsByChance([0.2] * 8, 1, independent=True), WORKS).find()
    assert verdict.fails is not None
    assert not verdict.is_sure


def test_a_rare_flaw_is_located() -> None:
    verdicts = [Bisection(RunsByChance([0] * 5 + [0.1] * 3, seed), WORKS).find() for seed in range(10)]
    assert sum(verdict.fails == 5 and verdict.is_sure for verdict in verdicts) >= 9


def test_the_exception_of_a_protocol_is_named(bisection_of: Callable[..., Bisection]) -> None:
    bisection = bisection_of("nodes[*] heard >= 6", "**.protocol.interval=-1")
    text = "\n".join(verdict_sentences(bisection, bisection.find()))
    assert "Run 0: TimerException: " in text
    assert "handle_timer" in text
    assert "protocol.py:" in text


def test_an_exception_at_a_higher_level_is_a_failure(bisection_of: Callable[..., Bisection]) -> None:
    """A real MAC refuses a message that is longer than its MTU."""
    bisection = bisection_of("nodes[*] heard >= 6", "**.protocol.size=5000", "**.protocol.step=0.01")
    verdict = bisection.find()
    assert (verdict.works, verdict.fails, verdict.is_sure) == (4, 5, True)
    failures = bisection.at_level(5).failures
    assert list(failures) == list(range(10))
    assert failures[0].exception == "CommunicationException"


def test_a_budget_of_less_than_a_run_at_each_level_is_refused(make_campaign: Callable[..., Campaign]) -> None:
    with pytest.raises(ConfigError, match=r" 7 .* 8, "):
        Bisection(make_campaign(), Assertion.parse("nodes[*] heard >= 6"), max_runs=7)


def test_a_small_budget_leaves_it_undecided(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign(SHORT, run_count=100)
    bisection = Bisection(campaign, Assertion.parse("nodes[*] heard >= 6"), max_runs=30)
    verdict = bisection.find()
    assert (verdict.works, verdict.fails, verdict.is_sure) == (4, 5, False)
    assert next(verdict_sentences(bisection, verdict)).startswith("Undecided ")


@pytest.mark.parametrize(("held", "most"), [(10, 0.2589), (9, 0.3942), (0, 1.0)])
def test_the_bound_of_failures_is_exact(held: int, most: float) -> None:
    tally = Tally([place < held for place in range(10)])
    assert tally.most_failures(0.95) == pytest.approx(most, abs=1e-4)
