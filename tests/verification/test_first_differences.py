"""Does the first difference between two runs name the callbacks that a flaw of timing is about?

Each protocol runs twice with one seed: without and with the effect that breaks it. The expected times follow
from the timers of the protocols. The callbacks were added after the first output had been seen.
"""

from dataclasses import dataclass
from pathlib import Path

import pytest

from gradysim.ladder.campaign import Campaign
from gradysim.ladder.difference import Event
from gradysim.ladder.explanation_words import explanation_sentences
from gradysim.ladder.why import Explanation, record_and_explain

pytestmark = pytest.mark.verify

FILE = Path(__file__).parent / "planted" / "planted.ini"
GUIDE = Path(__file__).parents[2] / "docs" / "how-to" / "find-what-breaks-a-protocol.md"


@dataclass(frozen=True)
class First:
    """The first difference of a protocol.

    Attributes:
        config: Name of its configuration.
        level: The level that breaks it.
        kind: What kind of difference it is.
        time_s: When the runs part, within 1 ms.
        node: Where.
        event: The callback.
        other: The callback on whose other side it comes.
        effect: What is done at one level only, in the words of a protocol.
    """

    config: str
    level: str
    kind: str
    time_s: float
    node: str
    event: Event
    other: str = ""
    effect: str = ""

    def __str__(self) -> str:
        return self.config


FIRST = (
    First(
        "Impatient",
        "airtime",
        "order",
        1.000001,
        "client",
        Event("packet", "server", "packet", is_answer=True),
        "timer look",
        "gave up",
    ),
    # The answer is there after 12.6 ms. The second timeout, at 16 ms, comes before it if the first copy of
    # the photo delays the answer.
    First(
        "StopAndWait",
        "access",
        "order",
        1.016,
        "camera",
        Event("packet", "base", "packet", is_answer=True),
        "timer timeout",
    ),
    First(
        "Deadline",
        "access",
        "order",
        0.105,
        "client",
        Event("packet", "server", "packet", is_answer=True),
        "timer deadline-#",
        "answered",
    ),
    # After 500 s, the clock of the drone is 250 ms fast: half a slot.
    First(
        "Slots",
        "clocks",
        "order",
        500.5,
        "base",
        Event("packet", "drones[1]", "timer send"),
        "timer slot",
        "mixed up",
    ),
    First("Photos", "wind", "position", 5, "drone", Event("telemetry"), "", "photos"),
    First("Burst", "access", "lost", 1, "sink", Event("packet", "logger", "timer upload")),
    First(
        "Synchronization",
        "airtime",
        "time",
        1,
        "drone",
        Event("packet", "station", "timer tell time"),
        "",
        "error",
    ),
    First(
        "LastFrames", "interference", "lost", 1, "drones[1]", Event("packet", "drones[0]", "timer heartbeat")
    ),
    First("Numbered", "interference", "lost", 1, "drones[1]", Event("packet", "drones[0]", "timer beat-#")),
    # Clocks 8.1 ms apart: the frame takes 1.9 ms of the 10 ms between them.
    First("HiddenSlots", "clocks", "lost", 51, "sink", Event("packet", "sensors[0]", "timer send")),
)


def explained(config: str, level: str, folder: Path, place: int = 0) -> tuple[Explanation, int]:
    """Return why a level breaks a protocol, and the number of the level."""
    campaign = Campaign(FILE, config, run_count=place + 1)
    fails = [each.name for each in campaign.levels].index(level)
    effects = (campaign.effects_up_to(fails - 1), campaign.effects_up_to(fails))
    files = (folder / "works.html", folder / "fails.html")
    return record_and_explain(campaign, effects, place, files), fails


@pytest.mark.parametrize("first", FIRST, ids=str)
def test_the_callbacks_are_named(first: First, tmp_path: Path) -> None:
    found = explained(first.config, first.level, tmp_path)[0].first
    assert found is not None
    assert (found.kind, found.node, found.event) == (first.kind, first.node, first.event)
    assert found.time_s == pytest.approx(first.time_s, abs=_WITHIN_S.get(first.config, 0.001))
    assert (found.other.name if found.other else "") == first.other
    if first.effect:
        assert first.effect in {each.what for effects in found.effects for each in effects}


_WITHIN_S = {"Slots": 1.5, "HiddenSlots": 2}
"""Where clocks drift, frames have a period and a length."""


@pytest.mark.parametrize(
    ("config", "level", "text"),
    [
        ("Impatient", "airtime", 'So timer "look" sets `gave up` to 1 and does not set `answered`'),
        (
            "StopAndWait",
            "access",
            'the answer of base comes 9.28 ms after timer "timeout" at level 3,'
            " and 3.35 ms before it at level 2",
        ),
        ("Synchronization", "airtime", " comes 54.1 µs later at level 2 than at level 1"),
        ("Photos", "wind", "it is 0.227 m away from its position at level "),
    ],
)
def test_the_guide_has_these_sentences(config: str, level: str, text: str, tmp_path: Path) -> None:
    explanation, fails = explained(config, level, tmp_path)
    assert text in "\n".join(explanation_sentences(explanation, fails - 1, fails))
    assert text.strip() in GUIDE.read_text(encoding="utf-8")


def test_an_exception_has_the_loss_before_it(tmp_path: Path) -> None:
    explanations = (explained("KeyError", "interference", tmp_path, place)[0] for place in range(10))
    first = next(each.first for each in explanations if each.first and each.first.kind == "lost")
    assert first.event == Event("packet", "drones[0]", "timer hello")
