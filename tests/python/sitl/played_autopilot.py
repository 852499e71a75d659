"""An autopilot in lock-step, played by the test: it sends motor commands by UDP."""

import json
import socket
import struct

from gradysim.motion.quadcopter import Quadcopter
from gradysim.sitl.lock_step import LockStepAutopilot
from gradysim.sitl.mavlink import MavlinkLink

SERVOS = "<HHI16H"
IDLE = [1000] * 16


class Process:
    """Process of a running autopilot."""

    is_running = True

    def last_output(self):
        return ""

    def exit_report(self):
        return "it died"


class Played:
    """The autopilot's side of the link, and the simulation's."""

    def __init__(self, name="vehicle 0", rate_hz=400, wind=None):
        self.ours = LockStepAutopilot(MavlinkLink(name), Quadcopter(), wind)
        self.physics = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.physics.connect(("127.0.0.1", self.ours.port))
        self.physics.settimeout(1.0)
        self.mavlink = socket.create_connection(("127.0.0.1", self.ours.mavlink_port))
        self.wish(1, rate_hz)
        self.ours.meet(Process(), 5.0)

    def wish(self, frame, rate_hz=400, pulses_us=IDLE, magic=18458):
        self.physics.send(struct.pack(SERVOS, magic, rate_hz, frame, *pulses_us))

    def felt(self):
        return json.loads(self.physics.recv(4096))

    def close(self):
        self.ours.close()
        self.physics.close()
        self.mavlink.close()
