"""Which level breaks a protocol."""

from collections.abc import Callable

import pytest

from gradysim.ladder.assertion import Assertion
from gradysim.ladder.bisect import Bisection
from gradysim.ladder.campaign import Campaign
from gradysim.ladder.words import verdict_sentences
from gradysim.scenario.errors import ConfigError

SHORT = "sim-time-limit=1.25s"
"""Three beacons of each node: at most 6 heard by each."""


@pytest.fixture
def bisection_of(make_campaign: Callable[..., Campaign]) -> Callable[..., Bisection]:
    """`bisection_of("nodes[*] heard >= 6", *settings)`: not yet run."""

    def bisection(assertion: str, *settings: str) -> Bisection:
        return Bisection(make_campaign(SHORT, *settings, run_count=100), Assertion.parse(assertion))

    return bisection


def test_the_level_that_breaks_lock_step_timers(bisection_of: Callable[..., Bisection]) -> None:
    bisection = bisection_of("nodes[*] heard >= 6")
    verdict = bisection.find()
    assert (verdict.works, verdict.fails, verdict.is_sure) == (3, 4, True)
    assert verdict.smallest == ("interference",)
    assert verdict.place == 0
    assert verdict.run_count == bisection.run_count < 60


def test_all_effects_that_are_needed_are_named(bisection_of: Callable[..., Bisection]) -> None:
    """A stronger frame survives a collision: without collisions, or without capture, nothing is missing."""
    candidates = "*.nodes[2].mobility.initialX=5m", "*.nodes[1].mobility.initialX=90m"
    bisection = bisection_of("nodes[*] heard != 1", *candidates, "*.nodes[2].protocol.sends=false")
    verdict = bisection.find()
    assert (verdict.works, verdict.fails) == (4, 5)
    assert verdict.smallest == ("interference", "capture")


def test_a_protocol_that_survives_all_levels(bisection_of: Callable[..., Bisection]) -> None:
    bisection = bisection_of("nodes[*] heard >= 6", "**.protocol.step=0.01")
    verdict = bisection.find()
    assert (verdict.works, verdict.fails) == (6, None)
    assert list(verdict_sentences(bisection, verdict)) == [
        "The protocol works up to the last level, 6 noise: 10 of 10 runs."
    ]


def test_a_protocol_that_never_works(bisection_of: Callable[..., Bisection]) -> None:
    bisection = bisection_of("nodes[*] heard >= 7")
    verdict = bisection.find()
    assert (verdict.works, verdict.fails, verdict.run_count) == (None, 0, 20)


@pytest.mark.parametrize(
    ("at_both_ends", "expected"),
    [((10, 8), (0, 6)), ((9, 9), (6, None)), ((8, 10), (6, None)), ((4, 2), (None, 0))],
)
def test_ends_that_hardly_differ(
    at_both_ends: tuple[int, int],
    expected: tuple[int | None, int | None],
    bisection_of: Callable[..., Bisection],
) -> None:
    bisection = bisection_of("nodes[*] heard >= 6")
    for level, successes in zip((0, 6), at_both_ends, strict=True):
        bisection.at_level(level).outcomes = [number < successes for number in range(10)]
    verdict = bisection.find()
    assert (verdict.works, verdict.fails) == expected
    assert verdict.is_sure == (None in expected)


def test_the_exception_of_a_protocol_is_named(bisection_of: Callable[..., Bisection]) -> None:
    bisection = bisection_of("nodes[*] heard >= 6", "**.protocol.interval=-1")
    text = "\n".join(verdict_sentences(bisection, bisection.find()))
    assert "10 of the runs at level 0 end with an exception: " in text


def test_a_budget_that_does_not_suffice_for_both_ends_is_refused(
    make_campaign: Callable[..., Campaign],
) -> None:
    with pytest.raises(ConfigError, match="a budget of 19 runs is too small; expected at least 20"):
        Bisection(make_campaign(), Assertion.parse("nodes[*] heard >= 6"), max_runs=19)


def test_a_small_budget_leaves_it_undecided(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign(SHORT, run_count=100)
    bisection = Bisection(campaign, Assertion.parse("nodes[*] heard >= 6"), max_runs=22)
    verdict = bisection.find()
    assert (verdict.works, verdict.fails, verdict.is_sure) == (0, 6, False)
    assert next(verdict_sentences(bisection, verdict)).startswith("Undecided after 20 runs")
