"""Autopilots in lock-step: they wait for our physics at each step, so their clock is ours.

This uses ArduPilot's interface for external physics (`--model JSON`, ArduCopter 4.1 and newer). The autopilot
sends its servo outputs by UDP and blocks. It continues with a line of JSON: sensor values and time.
"""

import asyncio
import logging
import select
import selectors
import socket
import struct
import time
from collections.abc import Sequence
from typing import Any, NoReturn, cast

from gradysim.encapsulator.nested_loop import outer_loop_stands
from gradysim.motion.quadcopter import Quadcopter
from gradysim.motion.wind import WindAtVehicle
from gradysim.sitl import SitlError
from gradysim.sitl.mavlink import MavlinkLink
from gradysim.sitl.process import AutopilotProcess

_logger = logging.getLogger(__name__)

RATE_HZ = 400
"""Steps per second, those of ArduCopter's main loop. It starts with 1200 until it reads its parameters."""

_SERVOS = struct.Struct("<HHI16H")
_SERVOS_MAGIC = 18458
_DATAGRAM = 256

PATIENCE_S = 0.25
"""Wall time between two checks that autopilots run."""

_HIGHEST_RATE_HZ = 100_000


class LockStepAutopilot:
    """Connects a link with an autopilot on simulated time. It computes between `answer` and `take_servos`.

    Attributes:
        link: Its messages.
        body: Its vehicle.
        time_s: Time of its clock, from 0.
        port: UDP port that it sends to.
        is_at_work: Whether it computes its next step.
        foreign_datagrams: How many came from elsewhere. They are ignored.
    """

    def __init__(self, link: MavlinkLink, body: Quadcopter, wind: WindAtVehicle | None = None) -> None:
        """Open the ports. Start the autopilot with them. `wind` replaces that of the vehicle."""
        self.link = link
        self._wind = wind
        self.body = body
        self.time_s = 0.0
        self._steps_from = (0.0, 0)  # start of the present step length, and steps since then
        self._rate_hz = 0
        self._throttles = (0.0, 0.0, 0.0, 0.0)
        self.is_at_work = False
        self._frame: int | None = None
        self._address: Any = None
        self.foreign_datagrams = 0
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
        """TCP port that the autopilot connects to. Valid before `meet`."""
        assert self._server is not None
        return int(self._server.getsockname()[1])

    def meet(self, process: AutopilotProcess, timeout_s: float) -> None:
        """Wait until a started autopilot waits for its first step.

        Raise SitlError if it ends, or does not connect within `timeout_s` of wall time.
        """
        self._process = process
        self.link.last_output = process.last_output
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
        while not self.take_servos():
            if not news.poll(PATIENCE_S * 1000):
                self.check(deadline_s, f"start: it did not ask for physics in {timeout_s:g} s")

    def fileno(self) -> int:
        """Return the file descriptor that is readable when `take_servos` has data."""
        return self._physics.fileno()

    def is_behind(self, time_s: float) -> bool:
        """Whether one more step brings it closer to a time."""
        return self.time_s + 0.5 / self._rate_hz <= time_s

    def answer(self) -> None:
        """Integrate one step and send the new sensor values."""
        body = self.body
        if self._wind is not None:
            body.wind_mps = self._wind.velocity_mps(self.time_s)
        body.step(self._throttles, 1.0 / self._rate_hz)
        # A multiple of a step, so that rounding errors do not add up.
        begin_s, steps = self._steps_from
        self._steps_from = (begin_s, steps + 1)
        self.time_s = begin_s + (steps + 1) / self._rate_hz
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

    def take_servos(self) -> bool:
        """Read the servo outputs for the next step. Return False if the autopilot still computes."""
        while True:
            try:
                data, sender = self._physics.recvfrom(_DATAGRAM)
            except BlockingIOError:
                return False
            if self._address not in (None, sender):
                self.foreign_datagrams += 1
                continue
            if len(data) != _SERVOS.size:
                continue
            magic, rate_hz, frame, *pulses_us = _SERVOS.unpack(data)
            # An autopilot that waits long repeats its frame. A second answer would shift its clock.
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
        """Read MAVLink messages. Return whether there were any. Raise SitlError if the autopilot has ended.

        The autopilot waits for its next step, so all its messages have arrived.
        """
        assert self._mavlink is not None
        try:
            data = self._mavlink.recv(1 << 16, socket.MSG_DONTWAIT)
        except BlockingIOError:
            return False
        except OSError:
            data = b""
        if not data:
            self._fail(self._exit_report())
        self.link.feed(data)
        return True

    def check(self, deadline_s: float, trouble: str) -> None:
        """Raise SitlError if the autopilot has ended, or `time.monotonic` is after `deadline_s`."""
        assert self._process is not None
        if not self._process.is_running:
            hint = "" if self._frame is not None else "; is it ArduCopter 4.1 or newer?"
            self._fail(self._exit_report() + hint)
        if time.monotonic() > deadline_s:
            printed = self.link.last_output()
            self._fail(f"{trouble}; it printed last: {printed}" if printed else trouble)

    def close(self) -> None:
        """Close the connections. Do nothing if they are closed."""
        if self.foreign_datagrams:
            _logger.warning(
                "%s: %d datagrams to its port came from elsewhere and were ignored",
                self.link.name,
                self.foreign_datagrams,
            )
            self.foreign_datagrams = 0
        self.link.lose("the connection was closed")
        for part in (self._physics, self._server, self._mavlink):
            if part is not None:
                part.close()

    def _send(self, data: bytes) -> None:
        assert self._mavlink is not None
        try:
            sent = self._mavlink.send(data, socket.MSG_DONTWAIT)
        except BlockingIOError:
            sent = 0
        except OSError:
            self._fail(self._exit_report())
        if sent < len(data):  # It reads nothing before its next step, so waiting would never end.
            self._fail("it got more commands than it can receive before its next step")

    def _exit_report(self) -> str:
        assert self._process is not None
        return self._process.exit_report()

    def _fail(self, why: str) -> NoReturn:
        self.link.lose(why)
        raise SitlError(f"{self.link.name}: {why}")


def _accepted(server: socket.socket) -> socket.socket | None:
    """Return the next connection, or None after the timeout."""
    try:
        return server.accept()[0]
    except TimeoutError:
        return None


_SILENCE_S = 10.0
"""Wall time without a step after which an autopilot has failed. It repeats its frame every second."""


class LockStepGroup:
    """Autopilots in lock-step that run at the same time, each as fast as it can."""

    def __init__(self, autopilots: Sequence[LockStepAutopilot]) -> None:
        self._autopilots = autopilots
        self._selector = selectors.DefaultSelector()
        for autopilot in autopilots:
            self._selector.register(autopilot, selectors.EVENT_READ)

    def fly_to(self, time_s: float) -> bool:
        """Run all autopilots to the step nearest to `time_s`. Return whether there were messages.

        Messages are handled when all have arrived, in their order, so the result does not depend on which one
        is fastest. Raise SitlError if an autopilot has ended or hangs.
        """
        behind = [each for each in self._autopilots if each.is_at_work or each.is_behind(time_s)]
        for autopilot in behind:
            if not autopilot.is_at_work:  # it may be at work after Ctrl-C
                autopilot.answer()
        last_sign_s = time.monotonic()
        while behind:
            has_gone_on = False
            for key, _ in self._selector.select(PATIENCE_S):
                autopilot = cast(LockStepAutopilot, key.fileobj)
                if autopilot.take_servos():  # not a repeated frame
                    has_gone_on = True
                    if autopilot.is_behind(time_s):
                        autopilot.answer()
                    else:
                        behind.remove(autopilot)
            if has_gone_on:
                last_sign_s = time.monotonic()
                continue
            for autopilot in behind:
                autopilot.check(last_sign_s + _SILENCE_S, f"no sign of life in {_SILENCE_S:g} s of wall time")
        said = [autopilot.listen() for autopilot in self._autopilots]
        return any(said)

    def close(self) -> None:
        """Stop watching the autopilots."""
        self._selector.close()


_ROUNDS = 12
"""Rounds of callbacks per turn: enough from a message to the next command."""


class VehicleClockLoop(asyncio.SelectorEventLoop):
    """An asyncio loop on the time of vehicles in lock-step. It passes only when they fly.

    So the steps of a `Vehicle` and their timeouts work the same on simulated time as on wall time, and are
    repeatable. The loop never sleeps. Close it with `cancel_all`.
    """

    def __init__(self) -> None:
        super().__init__()
        self._now_s = 0.0
        self._rounds_left = 0

    def time(self) -> float:
        """Return the time of the vehicles in seconds."""
        return self._now_s

    def turn(self, now_s: float) -> None:
        """Set the time to `now_s` and run the callbacks that are ready or due."""
        self._now_s = now_s
        self._rounds_left = _ROUNDS
        self.call_soon(self._run_round)
        with outer_loop_stands():
            self.run_forever()

    def cancel_all(self) -> None:
        """Cancel all tasks, let them finish, and close the loop. Do nothing if it is closed."""
        if self.is_closed():
            return
        for task in asyncio.all_tasks(self):
            task.cancel()
        self.turn(self._now_s)
        self.close()

    def _run_round(self) -> None:
        self._rounds_left -= 1
        if self._rounds_left == 0:
            self.stop()
        else:
            self.call_soon(self._run_round)
