"""Timers fire when docs/how-to/let-clocks-drift.md says so."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

PAGE = "docs/how-to/let-clocks-drift.md"

Shell = Callable[[str, Path], str]


@pytest.mark.parametrize("mode", ["integrated", "prototype"])
def test_a_timer_fires_when_the_clock_of_its_node_says_so(
    root: Path, shell: Shell, swarm: Path, mode: str
) -> None:
    drift = "*.vehicles[0].clock.oscillator.driftRate=1000ppm"
    command = f"gradysim run swarm/swarm.ini --mode {mode} --set '{drift}' --trace 'vehicles[0]' --quiet"
    first = next(line for line in shell(command, swarm).splitlines() if " timer " in line)
    assert f"{first.split()[0]} s" in " ".join((root / PAGE).read_text().split())
