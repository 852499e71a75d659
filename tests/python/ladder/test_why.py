"""What differs between a run that works and one that fails."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.ladder.campaign import Campaign
from gradysim.ladder.explanation_words import explanation_sentences
from gradysim.ladder.why import Explanation, record_and_explain


@pytest.fixture
def explanation_of(
    make_campaign: Callable[..., Campaign], tmp_path: Path
) -> Callable[..., tuple[Explanation, str]]:
    """`explanation_of("range", *settings)`: what that effect changes, and the sentences."""

    def explanation(effect: str, *settings: str) -> tuple[Explanation, str]:
        campaign = make_campaign(*settings)
        fails = [level.name for level in campaign.levels].index(effect)
        files = (tmp_path / "works.html", tmp_path / "fails.html")
        effects = (campaign.effects_up_to(fails - 1), campaign.effects_up_to(fails))
        found = record_and_explain(campaign, effects, 0, files)
        assert all(file.stat().st_size for file in files)
        return found, "\n".join(explanation_sentences(found, fails - 1, fails))

    return explanation


def test_losses_to_other_frames(explanation_of: Callable[..., tuple[Explanation, str]]) -> None:
    found, text = explanation_of("interference")
    assert next(iter(found.losses.items())) == ("receiver_transmitting", (0, 1))
    assert found.first is not None
    assert (found.first.time_s, found.first.event.cause) == (1, "timer beacon")
    assert found.first.outcomes == ("delivered", "receiver_transmitting")
    assert "`receiver transmitting`: 100.0% " in text
    assert '"beacon" from nodes[' in text


def test_receptions_out_of_range(explanation_of: Callable[..., tuple[Explanation, str]]) -> None:
    found, text = explanation_of("range", "*.nodes[*].mobility.lineStepX=70m")
    before, after = found.losses["below_sensitivity"]
    assert before == 0
    assert after == pytest.approx(1 / 3)  # from 0 to 2 and from 2 to 0, of 6 links
    assert ": 33.3% " in text
    assert "delivered" in text


def test_messages_that_did_not_fit_into_the_queue(
    explanation_of: Callable[..., tuple[Explanation, str]],
) -> None:
    burst = "**.protocol.interval=0.00001", "sim-time-limit=1.002s", "*.nodes[1..2].protocol.sends=false"
    found, text = explanation_of("access", *burst)
    assert found.messages["queue_overflow"][0] == 0
    assert found.messages["queue_overflow"][1] > 0.2
    assert "`queue overflow`" in text


def test_only_times_differ(explanation_of: Callable[..., tuple[Explanation, str]]) -> None:
    found, text = explanation_of("airtime", "**.protocol.step=0.01")
    assert found.first is not None
    assert found.first.kind == "time"
    assert "µs later " in text


def test_frames_in_the_air_at_the_end_are_not_out_of_range(
    explanation_of: Callable[..., tuple[Explanation, str]],
) -> None:
    """The last beacons start when the run ends."""
    found, text = explanation_of("airtime", "sim-time-limit=2s")
    assert found.losses == {"below_sensitivity": (0, 0)}
    assert "%" not in text


def test_nothing_differs(explanation_of: Callable[..., tuple[Explanation, str]]) -> None:
    found, text = explanation_of("range")
    assert found.first is None
    assert "same" in text
