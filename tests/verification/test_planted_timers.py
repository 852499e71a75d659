"""Does `gradysim desync` read all runs, and say what jitter does not help against?

Protocols of tests/verification/planted whose clashes occur in some runs only, whose clocks differ, or whose
runs fail.
"""

from pathlib import Path

import pytest

from gradysim.ladder.campaign import Campaign
from gradysim.ladder.desync import Desync, desynchronize
from gradysim.ladder.desync_words import desync_sentences

pytestmark = pytest.mark.verify

FILE = Path(__file__).parent / "planted" / "planted.ini"
GUIDE = Path(__file__).parents[2] / "docs" / "how-to" / "desynchronize-timers.md"


def found_in(config: str, run_count: int) -> tuple[Desync, str]:
    """Return what is found in the runs of a configuration, and the sentences."""
    found = desynchronize(Campaign(FILE, config, run_count=run_count))
    return found, "\n".join(desync_sentences(found))


def test_a_clash_in_half_of_the_runs_is_found() -> None:
    """Both candidates draw one of two slots, once."""
    found, _ = found_in("RandomSlots", 12)
    assert found.diagnosis.receptions == 24
    assert 0 < found.diagnosis.clashes < 24
    (pattern,) = found.diagnosis.patterns
    assert pattern.verdict == "synchronized"
    assert found.timers == (("candidates[*]", "claim"),)
    assert found.jitter_s
    assert max(trial.delivery for trial in found.trials) == 1


def test_hidden_slots_that_drift_need_a_clock() -> None:
    found, text = found_in("HiddenSlots", 1)
    (pattern,) = found.diagnosis.patterns
    assert pattern.verdict == "hidden and drifting"
    assert (found.timers, found.jitter_s) == ((), None)
    assert "agree on a clock, or use RTS and CTS" in text
    assert "by a random time" not in text


def test_timers_that_differ_in_numbers_are_delayed_together() -> None:
    found, _ = found_in("Numbered", 2)
    assert found.timers == (("drones[*]", "beat-#"),)
    assert found.trials[0].delivery == 0
    assert max(trial.delivery for trial in found.trials) > 0.95


def test_the_last_frames_do_not_arrive() -> None:
    found, _ = found_in("LastFrames", 1)
    assert found.trials[0].delivery == 0
    assert found.diagnosis.clashes == found.diagnosis.receptions == 19 * 12


def test_runs_that_fail_are_named_and_cured() -> None:
    """The base raises KeyError in the runs in which the hellos collide."""
    found, text = found_in("KeyError", 8)
    assert 0 < len(found.failures) < 8
    assert {each.exception for each in found.failures.values()} == {"KeyError"}
    assert all(each.where.startswith("in handle_packet of node 0 ") for each in found.failures.values())
    assert found.timers == (("drones[*]", "hello"),)
    chosen = next(trial for trial in found.trials if trial.jitter_s == found.jitter_s)
    assert chosen.failures == {}
    assert f"With it, 0 of 8 runs fail; without it, {len(found.failures)}." in text


def test_the_guide_shows_what_is_said_of_failures() -> None:
    _, text = found_in("KeyError", 4)
    shown = GUIDE.read_text(encoding="utf-8").split("```text")[2].split("```")[0]
    said = text.replace(f"{FILE.parent}/", "").splitlines()
    assert shown.split() == "\n".join([said[0], *said[3:]]).split()
