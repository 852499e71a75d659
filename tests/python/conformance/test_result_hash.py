"""In both modes, a changed line of a protocol that has an effect gives another result hash."""

from collections.abc import Callable
from pathlib import Path

import pytest

import gradysim as gs
from gradysim.results.result import RunResult

PROTOCOL = """
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand


class Greeter(IProtocol):
    def initialize(self):
        self.provider.tracked_variables["heard"] = 0
        self.provider.send_communication_command(BroadcastMessageCommand("hi"))
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(5, 0, 0))

    def handle_timer(self, timer): ...

    def handle_packet(self, message):
        self.provider.tracked_variables["heard"] += 1
"""
FILE = """
[General]
sim-time-limit = 2s
*.numN = 2
*.n[*].protocol.class = "greeter.py:Greeter"
*.n[*].mobility.lineStepX = 10m
*.n[*].mobility.initialX = 0m
"""


@pytest.fixture
def hash_of(tmp_path: Path) -> Callable[..., str]:
    (tmp_path / "file.ini").write_text(FILE)

    def run(mode: str, line: str = "", instead: str = "") -> str:
        assert line in PROTOCOL
        (tmp_path / "greeter.py").write_text(PROTOCOL.replace(line, instead))
        result = gs.run(tmp_path / "file.ini", mode=mode)
        assert isinstance(result, RunResult)
        return result.result_hash

    return run


@pytest.mark.parametrize("mode", ["integrated", "prototype"])
@pytest.mark.parametrize(
    ("line", "instead"),
    [("(5, 0, 0)", "(30, 0, 0)"), ("+= 1", "+= 7"), ('"hi"', '"ho"')],
    ids=["position", "tracked variable", "message"],
)
def test_one_changed_line(hash_of: Callable[..., str], mode: str, line: str, instead: str) -> None:
    is_seen = mode == "integrated" or line != '"hi"'  # prototype mode keeps no trace of texts
    assert (hash_of(mode, line, instead) != hash_of(mode)) == is_seen
