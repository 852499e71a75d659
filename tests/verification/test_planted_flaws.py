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
_RUNS = 100
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


@each_flaw
def test_desync_names_the_timers(flaw: Flaw) -> None:
    found = desynchronize(Campaign(FILE, flaw.config, run_count=_TRIALS))
    assert tuple(f"{group} {timer}" for group, timer in found.timers) == flaw.timers
    if flaw.verdict:
        assert found.diagnosis.patterns[0].verdict == flaw.verdict
