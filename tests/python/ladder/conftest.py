"""Small campaigns: nodes on a line that broadcast at given times."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.ladder.campaign import Campaign
from gradysim.ladder.clashes import Diagnosis, diagnose
from gradysim.ladder.kept_runs import KeptRuns
from gradysim.replay.reader import read_replay
from python.quiet_protocol import QUIET

pytest.importorskip("gradysim._netsim")

PROTOCOL = f"""{QUIET}
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand

class Beacon(Quiet):
    first: float = 1.0
    interval: float = 0.1
    spread: float = 0.0
    size: int = 50
    answers: bool = False
    sends: bool = True
    step: float = 0.0
    timer: str = "beacon"
    def initialize(self):
        self.provider.tracked_variables["heard"] = 0
        self.due = self.first + self.step * self.provider.get_id()
        if self.sends:
            self.schedule()
    def schedule(self):
        timer = self.timer.replace("#", str(round(10 * self.due)))
        self.provider.schedule_timer(timer, self.due + self.provider.random.uniform(0, self.spread))
    def say(self, text):
        self.provider.send_communication_command(BroadcastMessageCommand(text.ljust(self.size)))
    def handle_timer(self, timer):
        self.say("beacon")
        self.provider.tracked_variables["sent"] = self.provider.current_time()
        self.due += self.interval
        self.schedule()
    def handle_packet(self, message):
        self.provider.tracked_variables["heard"] += 1
        if self.answers and message.strip() == "beacon":
            self.say("answer")
"""

INI = """[General]
sim-time-limit = 5.05s
*.numNodes = 3
**.protocol.class = "protocol.py:Beacon"
**.mobility.typename = "StationaryMobility"
**.mobility.telemetryInterval = 0s
*.nodes[*].mobility.lineStepX = 10m
# -85 dBm, the sensitivity, at 100 m.
**.wlan[*].radio.transmitter.power = 0.32mW
"""


@pytest.fixture
def make_campaign(tmp_path: Path) -> Callable[..., Campaign]:
    """`make_campaign(*settings, file="...")`: three nodes that send beacons; `file` ends the .ini file."""

    def make(
        *settings: str,
        file: str = "",
        run_count: int = 1,
        config: str = "General",
        kept: KeptRuns | None = None,
    ) -> Campaign:
        (tmp_path / "protocol.py").write_text(PROTOCOL, encoding="utf-8")
        (tmp_path / "test.ini").write_text(INI + file, encoding="utf-8")
        return Campaign(tmp_path / "test.ini", config, settings=settings, run_count=run_count, kept=kept)

    return make


@pytest.fixture
def diagnosis_of(make_campaign: Callable[..., Campaign], tmp_path: Path) -> Callable[..., Diagnosis]:
    """`diagnosis_of(*settings)`: what a run with all effects shows."""

    def diagnosis(*settings: str, file: str = "") -> Diagnosis:
        campaign = make_campaign(*settings, file=file)
        campaign.record(campaign.all_effects, 0, tmp_path / "run.html")
        return diagnose(read_replay(tmp_path / "run.html"))

    return diagnosis
