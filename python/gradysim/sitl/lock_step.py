"""One autopilot in lock-step: it waits for our physics at each of its steps, so its clock is ours.

ArduPilot's interface for simulators of the vehicle (`--model JSON`, ArduCopter 4.1 and newer): by UDP it
sends what its motors do and blocks; it goes on when it is told, as a line of JSON, what its sensors are to
feel, and at what time.
"""

import select
import socket
import struct
import time
from typing import Any, NoReturn

from gradysim.sitl.error import SitlError
from gradysim.sitl.link import MavlinkLink
from gradysim.sitl.process import AutopilotProcess
from gradysim.sitl.quadcopter import Quadcopter

RATE_HZ = 400
"""Steps in a second of the vehicle: those of ArduCopter's main loop. It starts with 1200 until it knows."""

_SERVOS = struct.Struct("<HHI16H")
_SERVOS_MAGIC = 18458
_DATAGRAM = 256

PATIENCE_S = 0.25
"""Of wall time, between two looks at whether autopilots live."""

_HIGHEST_RATE_HZ = 100_000


class LockStepAutopilot:
    """Joins a link with an autopilot on simulated time. It works between `answer` and the next `take_wish`.

    Attributes:
        link: Its messages.
        body: Its vehicle.
        time_s: What its clock shows, from 0.
        port: Of UDP, where it sends to.
        is_at_work: Whether it has been answered, and has not got to its next step.
    """

    def __init__(self, link: MavlinkLink, body: Quadcopter) -> None:
        """Open the ports; the autopilot is to be started with them."""
        self.link = link
        self.body = body
        self.time_s = 0.0
        self._steps_from = (0.0, 0)  # since when they have been of one length, and how many there were
        self._rate_hz = 0
        self._throttles = (0.0, 0.0, 0.0, 0.0)
        self.is_at_work = False
        self._frame: int | None = None
        self._address: Any = None
        self._process: AutopilotProcess | None = None
        self._physics = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._physics.bind(("127.0.0.1", 0))
        self._physics.setblocking(False)
        self.port: int = self._physics.getsockname()[1]
        self._server: socket.socket | None = socket.create_server(("127.0.0.1", 0))
        self._server.settimeout(PATIENCE_S)
        self._mavlink: socket.socket | None = None

    @property
    def mavlink_port(self) -> int:
        """Of TCP, where the autopilot connects to, before `meet`."""
        assert self._server is not None
        return int(self._server.getsockname()[1])

    def meet(self, process: AutopilotProcess, timeout_s: float) -> None:
        """Wait for an autopilot that was started, until it waits for its first step.

        Raises:
            SitlError: It ends, or does not connect in `timeout_s` of wall time.
        """
        self._process = process
        self.link.last_words = process.last_words
        server, self._server = self._server, None
        assert server is not None
        deadline_s = time.monotonic() + timeout_s
        with server:
            while (connection := _accepted(server)) is None:
                self.check(deadline_s, f"start: it did not connect in {timeout_s:g} s")
        self._mavlink = connection
        self._mavlink.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.link.send_bytes = self._send
        news = select.poll()
        news.register(self, select.POLLIN)
        while not self.take_wish():
            if not news.poll(PATIENCE_S * 1000):
                self.check(deadline_s, f"start: it did not ask for physics in {timeout_s:g} s")

    def fileno(self) -> int:
        """Return what to wait for until `take_wish` has something to take."""
        return self._physics.fileno()

    def is_behind(self, time_s: float) -> bool:
        """Whether one more step takes it nearer to a time."""
        return self.time_s + 0.5 / self._rate_hz <= time_s

    def answer(self) -> None:
        """Fly one step, and let the autopilot go on with what its sensors feel then."""
        body = self.body
        body.step(self._throttles, 1.0 / self._rate_hz)
        self._count_step()
        p, q, r = body.rates_radps
        ax, ay, az = body.specific_force_mps2
        north, east, down = body.position_m
        w, x, y, z = body.attitude
        vn, ve, vd = body.velocity_mps
        text = (
            f'\n{{"timestamp":{self.time_s!r},"imu":{{"gyro":[{p!r},{q!r},{r!r}],'
            f'"accel_body":[{ax!r},{ay!r},{az!r}]}},"position":[{north!r},{east!r},{down!r}],'
            f'"quaternion":[{w!r},{x!r},{y!r},{z!r}],"velocity":[{vn!r},{ve!r},{vd!r}]}}\n'
        )
        self.is_at_work = True
        self._physics.sendto(text.encode(), self._address)

    def take_wish(self) -> bool:
        """Take what the motors are to do in the next step; whether the autopilot has got so far."""
        while True:
            try:
                data, sender = self._physics.recvfrom(_DATAGRAM)
            except BlockingIOError:
                return False
            if len(data) != _SERVOS.size:
                continue
            magic, rate_hz, frame, *pulses_us = _SERVOS.unpack(data)
            # One that had to wait for us says the same again: answered twice, its clock would be off.
            if magic == _SERVOS_MAGIC and frame != self._frame and 0 < rate_hz <= _HIGHEST_RATE_HZ:
                break
        self.is_at_work = False
        self._frame, self._address = frame, sender
        a, b, c, d = (min(1.0, max(0.0, (pulse_us - 1000) / 1000)) for pulse_us in pulses_us[:4])
        self._throttles = (a, b, c, d)
        if rate_hz != self._rate_hz:
            self._rate_hz = rate_hz
            self._steps_from = (self.time_s, 0)
        return True

    def listen(self) -> bool:
        """Take what came by MAVLink; whether there was something.

        While the autopilot waits for its next step that is all that it has had to say.

        Raises:
            SitlError: It is gone.
        """
        assert self._mavlink is not None
        try:
            data = self._mavlink.recv(1 << 16, socket.MSG_DONTWAIT)
        except BlockingIOError:
            return False
        except OSError:
            data = b""
        if not data:
            self._give_up(self._obituary())
        self.link.feed(data)
        return True

    def check(self, deadline_s: float, trouble: str) -> None:
        """Raise SitlError if the autopilot has ended, or for `trouble` after a time of `time.monotonic`."""
        assert self._process is not None
        if not self._process.is_running:
            guess = "" if self._frame is not None else "; is it ArduCopter 4.1 or newer?"
            self._give_up(self._obituary() + guess)
        if time.monotonic() > deadline_s:
            printed = self.link.last_words()
            self._give_up(f"{trouble}; it printed last: {printed}" if printed else trouble)

    def close(self) -> None:
        """Leave the autopilot, which cannot go on; no-op if that has happened."""
        self.link.lose("the connection was closed")
        for part in (self._physics, self._server, self._mavlink):
            if part is not None:
                part.close()

    def _count_step(self) -> None:
        """Let the clock go on; as a multiple of a step, so that rounding does not add up."""
        begin_s, steps = self._steps_from
        self._steps_from = (begin_s, steps + 1)
        self.time_s = begin_s + (steps + 1) / self._rate_hz

    def _send(self, data: bytes) -> None:
        assert self._mavlink is not None
        try:
            sent = self._mavlink.send(data, socket.MSG_DONTWAIT)
        except BlockingIOError:
            sent = 0
        except OSError:
            self._give_up(self._obituary())
        if sent < len(data):  # It reads nothing before its next step: who waits now waits for ever.
            self._give_up("it was given more orders than it can take before its next step")

    def _obituary(self) -> str:
        assert self._process is not None
        return self._process.obituary()

    def _give_up(self, why: str) -> NoReturn:
        self.link.lose(why)
        raise SitlError(f"{self.link.name}: {why}")


def _accepted(server: socket.socket) -> socket.socket | None:
    """Return the next connection; None if there is none for a while."""
    try:
        return server.accept()[0]
    except TimeoutError:
        return None
