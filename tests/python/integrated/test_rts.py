"""Results count RTS and CTS of runs that use them."""

from pathlib import Path

import pytest

from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios

HIDDEN = Path(__file__).parents[3] / "configs" / "reference" / "hidden.ini"


@pytest.mark.parametrize(("config", "any_sent"), [("General", False), ("RtsCts", True)])
def test_rts_and_cts_are_counted(config: str, any_sent: bool) -> None:
    (scenario,) = load_scenarios(HIDDEN, config, overrides=["sim-time-limit = 50ms"])
    frames = run(scenario).outcomes["frames"]
    assert all((frames[kind]["delivered"] > 0) is any_sent for kind in ("rts", "cts"))
