"""RTS and CTS are in the results of runs that use them, and only there."""

from pathlib import Path

import pytest

from gradysim.config import load_scenarios
from gradysim.integrated.run import run

HIDDEN = Path(__file__).parents[3] / "configs" / "reference" / "hidden.ini"


@pytest.mark.parametrize(("config", "kinds"), [("General", set()), ("RtsCts", {"rts", "cts"})])
def test_rts_and_cts_are_counted_if_any_was_sent(config: str, kinds: set[str]) -> None:
    (scenario,) = load_scenarios(HIDDEN, config, overrides=["sim-time-limit = 50ms"])
    frames = run(scenario).fates["frames"]
    assert set(frames) == {"broadcast"} | {
        kind + suffix for kind in {"unicast", "ack", *kinds} for suffix in ("", " overheard")
    }
    assert all(frames[kind]["delivered"] > 0 for kind in kinds)
