"""Campaigns of two or more nodes whose protocols are written in a test."""

from pathlib import Path

from gradysim.ladder.campaign import Campaign
from gradysim.ladder.recording import Recording, read_recording, record_to_files
from python.quiet_protocol import QUIET

_PROTOCOLS = f"""{QUIET}
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand

class Node(Quiet):
    def broadcast(self, text):
        self.provider.send_communication_command(BroadcastMessageCommand(text))
    def send(self, text, destination):
        self.provider.send_communication_command(SendMessageCommand(text, destination))
    def after(self, timer, delay):
        self.provider.schedule_timer(timer, self.provider.current_time() + delay)
    def count(self, name):
        self.provider.tracked_variables[name] = self.provider.tracked_variables.get(name, 0) + 1
"""

_NODES = """[General]
*.base.mobility.initialY = 0m
*.other.mobility.initialY = 0m
"""
"""The order of the nodes."""

_INI = """
*.base.protocol.class = "protocol.py:Base"
*.other.protocol.class = "protocol.py:Other"
sim-time-limit = 3.5s
*.other.mobility.initialX = 20m
**.mobility.typename = "StationaryMobility"
**.mobility.telemetryInterval = 0s
# -85 dBm, the sensitivity, at 100 m.
**.wlan[*].radio.transmitter.power = 0.32mW
"""


class Scripted:
    """Two nodes: `base`, node 0, and `other`, node 1."""

    def __init__(self, folder: Path, protocols: str, ini: str = "", run_count: int = 1) -> None:
        """Write the files.

        `protocols` has the classes Base and Other, which extend Node. `ini` has lines that come first.
        """
        (folder / "protocol.py").write_text(_PROTOCOLS + protocols, encoding="utf-8")
        (folder / "test.ini").write_text(f"{_NODES}{ini}{_INI}", encoding="utf-8")
        self._folder = folder
        self.campaign = Campaign(folder / "test.ini", run_count=run_count)

    def recording(self, level: str) -> Recording:
        """Return the run with the effects up to a level."""
        number = [each.name for each in self.campaign.levels].index(level)
        path, rest = self._folder / f"{level}.html", self._folder / level
        record_to_files(self.campaign, self.campaign.effects_up_to(number), 0, path, rest)
        return read_recording(path, rest)
