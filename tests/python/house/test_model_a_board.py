"""What docs/how-to/model-a-board.md shows is what happens."""

import math
import random
import re
import statistics
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from textwrap import indent
from typing import Any

import pytest

from gradysim.scenario import load_scenarios

pytest.importorskip("gradysim._netsim")

from gradysim.integrated.run import run

PAGE = "docs/how-to/model-a-board.md"
SPREAD = "*.*.computer.processingTimeSpread"
CodeBlocks = Callable[[str, str], list[str]]


@pytest.mark.parametrize(("changes", "readings"), [(None, 0), (f"{SPREAD}=0", 0), ("", 272)])
def test_its_readings(root: Path, code_blocks: CodeBlocks, changes: str | None, readings: int) -> None:
    (lines,) = code_blocks(PAGE, "sh")
    board, scenario_lines = (
        re.findall(r"--set ([^\s\"]+)", next(line for line in lines.splitlines() if line.startswith(name)))
        for name in ("board=", "scenario=")
    )
    overrides = scenario_lines if changes is None else [*filter(None, [changes]), *board, *scenario_lines]
    (scenario,) = load_scenarios(root / "configs/zigzag.ini", "ZigZag5Synchronised", overrides=overrides)
    station = next(node for node in run(scenario).nodes if node.name == "groundStation")
    assert station.tracked_variables["data"] == readings
    if readings:
        assert f" {readings} readings" in (root / PAGE).read_text(encoding="utf-8")


BURST = """
class Tested(Quiet):
    interval = 1.0
    def initialize(self):
        for _ in range(3):
            self.provider.send_communication_command(BroadcastMessageCommand("burst"))
    def finish(self):
        self.provider.tracked_variables["interval"] = self.interval
"""


def test_its_callback_is_called_unless_the_queue_blocks(make_scenario: Any, code_blocks: CodeBlocks) -> None:
    (callback,), (blocks,) = code_blocks(PAGE, "python"), code_blocks(PAGE, "ini")
    python = BURST + indent(callback, "    ")
    full = "**.pendingQueue.packetCapacity = 1"
    for lines, interval in (((full,), 4.0), ((full, blocks.strip()), 1.0)):
        nodes = run(make_scenario(python, *lines)).nodes
        assert {node.tracked_variables["interval"] for node in nodes} == {interval}


@pytest.fixture
def profile(tmp_path: Path) -> tuple[float, float]:
    """Median in seconds and spread of as_measured_companion.ini."""
    (tmp_path / "board.ini").write_text(
        '[General]\nsim-time-limit = 1s\n*.numN = 1\n*.n[*].protocol.typename = "SinkProtocol"\n'
        "include as_measured_companion.ini\n"
    )
    (scenario,) = load_scenarios(tmp_path / "board.ini")
    computer = scenario.nodes[0].computer
    return float(computer["processing_time_s"].value), float(computer["processing_time_spread"].value)


def test_its_profile_has_the_measured_intervals(profile: tuple[float, float]) -> None:
    """A sender and a receiver make the median of the measured standard deviations, 12.7 ms."""
    median_s, spread = profile
    draws = random.Random(1)
    deviations_s = []
    for _ in range(300):
        times_s = [
            sum(median_s * math.exp(spread * draws.gauss(0, 1)) for _ in ("sender", "receiver"))
            for _ in range(76)
        ]
        deviations_s.append(statistics.stdev(b - a for a, b in pairwise(times_s)))
    assert statistics.median(deviations_s) == pytest.approx(12.7e-3, rel=0.1)
    assert median_s * math.exp(2.326 * spread) == pytest.approx(33e-3, abs=0.5e-3)
