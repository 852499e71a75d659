"""The lines in docs/reference/studies.md give the runs on the page."""

from pathlib import Path

import pytest

from gradysim.scenario import ConfigError, load_scenarios
from gradysim.scenario.load import OF_SCRIPT, Study

PAGE = "docs/reference/studies.md"

INI = """
[General]
sim-time-limit = 1s
*.numNodes = 2
*.nodes[*].protocol.class = "quiet.py:Quiet"
*.nodes[*].mobility.typename = "StationaryMobility"
"""

PROTOCOL = """
from gradysim.protocol.interface import IProtocol


class Quiet(IProtocol):
    jitter: float = 0.0
    def initialize(self): ...
    def handle_timer(self, timer): ...
    def handle_packet(self, message): ...
    def handle_telemetry(self, telemetry): ...
    def finish(self): ...
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "quiet.py").write_text(PROTOCOL)
    (tmp_path / "quiet.ini").write_text(INI)
    return tmp_path / "quiet.ini"


@pytest.mark.parametrize(
    ("line", "others", "runs"),
    [
        ("*.nodes[*].protocol.jitter = ${10ms, 50ms}", [], 2),
        ("*.nodes[*].protocol.jitter = ${jitter=10ms, 50ms}", [], 2),
        ("*.nodes[*].mobility.lineStepX = ${10..60 step 10}m", [], 6),
        (
            "**.wlan[*].bitrate = ${6Mbps, 12Mbps ! jitter}",
            ["*.nodes[*].protocol.jitter = ${jitter=1s, 2s}"],
            2,
        ),
        ("*.nodes[*].protocol.jitter = ${jitter=1ms, 5ms ! repetition}", ["repeat = 2"], 2),
        (
            "constraint = $nodes < 50 && $jitter != 0s",
            ["*.numNodes = ${nodes=10, 100}", "*.nodes[*].protocol.jitter = ${jitter=0s, 1s, 2s}"],
            2,
        ),
        ("repeat = 10", [], 10),
        ("seed-set = ${repetition}", [], 1),
    ],
)
def test_its_lines_make_runs(root: Path, file: Path, line: str, others: list[str], runs: int) -> None:
    assert f"| `{line}` |" in (root / PAGE).read_text()
    assert len(load_scenarios(file, overrides=[line, *others])) == runs


def test_its_other_order_of_runs(root: Path, file: Path) -> None:
    line = "iteration-nesting-order = repetition, *"
    assert f"| `{line}` |" in (root / PAGE).read_text()
    values = ["*.nodes[*].protocol.jitter = ${1ms, 2ms}", "repeat = 2"]
    scenarios = load_scenarios(file, overrides=[*values, line])
    runs = [(scenario.repetition, scenario.iterations["0"]) for scenario in scenarios]
    assert runs == [(0, "1ms"), (0, "2ms"), (1, "1ms"), (1, "2ms")]


def test_a_mistake_in_the_number_of_a_run_shows_when_it_starts(root: Path, file: Path) -> None:
    row = "| when a run starts | other combinations of values, `${runnumber}` in a value"
    assert row in (root / PAGE).read_text()
    line = "*.nodes[*].mobility.initialX = 10m / (${runnumber} - 350)"
    study = Study(file, "General", None, ["repeat = 400", line], None, OF_SCRIPT)
    assert len(study.checked_in_full()) < 350
    with pytest.raises(ConfigError) as caught:
        study[350]
    assert caught.value.key == "*.nodes[*].mobility.initialX"
