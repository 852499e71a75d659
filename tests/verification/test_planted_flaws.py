"""Do `gradysim bisect` and `gradysim desync` name the flaws that were planted into small protocols?

The expectations are those of the physics. They were written down before the first run.
"""

from dataclasses import dataclass
from pathlib import Path

import pytest

from gradysim.ladder.assertion import Assertion
from gradysim.ladder.bisect import Bisection
from gradysim.ladder.campaign import Campaign
from gradysim.ladder.desync import desynchronize

pytestmark = pytest.mark.verify

FILE = Path(__file__).parent / "planted" / "planted.ini"
_RUNS = 400
_TRIALS = 2


@dataclass(frozen=True)
class Flaw:
    """One protocol.

    Attributes:
        config: Name of its configuration.
        assertion: What it achieves in an ideal world.
        level: The level that an expert would name.
        effects: The smallest set of effects that makes it fail.
        verdict: Why its messages clash; "" if they are not lost to each other.
        timers: The timers that need jitter, "GROUP NAME".
    """

    config: str
    assertion: str
    level: str
    effects: set[str]
    verdict: str = ""
    timers: tuple[str, ...] = ()

    def __str__(self) -> str:
        return self.config


FLAWS = (
    Flaw(
        "LockStep",
        "drones[*] heard >= 54",
        "interference",
        {"airtime", "interference"},
        "synchronized",
        ("drones[*] heartbeat",),
    ),
    Flaw("NoRetry", "drones[*] landed >= 1", "fading", {"range", "radio", "fading"}),
    Flaw("NoRetryTwo", "drones[*] landed >= 1", "fading", {"range", "radio", "fading"}),
    # The clash was not foreseen: the camera and the neighbor are hidden from each other, and in lock-step.
    Flaw(
        "Order",
        "base kept >= 18",
        "access",
        {"range", "airtime", "access"},
        "synchronized",
        ("camera send", "neighbor send"),
    ),
    Flaw("Upload", "sink collected >= 150", "access", {"airtime", "access"}),
    Flaw("Timeout", "client answered >= 18", "airtime", {"airtime"}),
    Flaw("Hidden", "sink share >= 0.9", "interference", {"range", "airtime", "interference"}, "hidden"),
    Flaw("Clock", "drone news >= 54", "clocks", {"clocks"}),
    Flaw("Edge", "drone corrections >= 45", "noise", {"radio", "noise"}),
    Flaw("Wall", "drone corrections >= 45", "obstacles", {"radio", "obstacles"}),
    Flaw("Overhead", "drone corrections >= 45", "antennas", {"range", "radio", "antennas"}),
    Flaw(
        "Election",
        "followers[*] wrong == 0",
        "capture",
        {"airtime", "radio", "interference", "capture"},
        "synchronized",
        ("candidates[*] claim",),
    ),
    # All drones hear the poll at the same time, so their answers are as synchronized as timers.
    Flaw("Poll", "base answers >= 342", "interference", {"airtime", "interference"}, "synchronized"),
    Flaw("OneHop", "base reports >= 95", "range", {"range"}),
    # Capture hides the flaw again at the levels above.
    Flaw(
        "TwoBeacons",
        "base near >= 190",
        "interference",
        {"range", "airtime", "interference"},
        "synchronized",
        ("far beacon", "near beacon"),
    ),
)

each_flaw = pytest.mark.parametrize("flaw", FLAWS, ids=str)


@each_flaw
def test_bisection_names_the_effect(flaw: Flaw) -> None:
    campaign = Campaign(FILE, flaw.config, run_count=_RUNS)
    verdict = Bisection(campaign, Assertion.parse(flaw.assertion)).find()
    assert verdict.works is not None
    assert verdict.fails is not None
    assert verdict.is_sure
    assert campaign.levels[verdict.fails].name == flaw.level
    assert set(verdict.smallest) == flaw.effects


def test_a_flaw_in_a_tenth_of_the_runs_is_located() -> None:
    campaign = Campaign(FILE, "TenSlots", run_count=_RUNS)
    verdict = Bisection(campaign, Assertion.parse("candidates[*] heard >= 1")).find()
    assert verdict.fails is not None
    assert verdict.is_sure
    assert campaign.levels[verdict.fails].name == "interference"


def test_an_exception_is_a_failure_with_its_line() -> None:
    campaign = Campaign(FILE, "KeyError", run_count=_RUNS)
    bisection = Bisection(campaign, Assertion.parse("events > 0"))
    verdict = bisection.find()
    assert verdict.fails is not None
    assert campaign.levels[verdict.fails].name == "interference"
    failure = next(iter(bisection.at_level(verdict.fails).failures.values()))
    assert failure.exception == "KeyError"
    assert failure.where.startswith("in handle_packet of node 0")
    assert "key_error.py:" in failure.line


@each_flaw
def test_desync_names_the_timers(flaw: Flaw) -> None:
    found = desynchronize(Campaign(FILE, flaw.config, run_count=_TRIALS))
    assert tuple(f"{group} {timer}" for group, timer in found.timers) == flaw.timers
    if flaw.verdict:
        assert found.diagnosis.patterns[0].verdict == flaw.verdict
