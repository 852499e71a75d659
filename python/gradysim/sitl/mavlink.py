"""MAVLink messages to and from one vehicle, with the ArduPilot dialect of pymavlink (an extra)."""

import asyncio
import importlib
from collections import deque
from collections.abc import Callable
from functools import cache
from typing import Any

from gradysim.sitl import SitlError

COPTER_GUIDED = 4
"""Mode GUIDED of ArduCopter, in which it accepts commands; `custom_mode` of its HEARTBEAT."""


@cache
def load_dialect() -> Any:
    """Return the module with messages and constants. ModuleNotFoundError names the command to install it.

    Only the dialect is used, not pymavlink's connections. So the environment variable `MAVLINK20` does not
    matter: this module writes version 2.
    """
    try:
        return importlib.import_module("pymavlink.dialects.v20.ardupilotmega")
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "autopilots need the package pymavlink: pip install pymavlink", name=error.name
        ) from error


Message = Any
"""A message of the dialect. `get_type()` is its name."""

_GROUND_STATION = 255
"""System id of a ground station by MAVLink's convention. Vehicles accept its commands."""

_MISSION_PLANNER = 190
"""Component id of a ground station program."""

_TEXTS_KEPT = 8


class MavlinkLink:
    """Messages of one vehicle, with its own parser. Bytes arrive by `feed` and leave by `send_bytes`.

    Attributes:
        latest: Latest message of each type, by its name.
        texts: Latest texts (STATUSTEXT) of the autopilot, the newest last.
        lost: Reason why the link is lost; None while it is not.
        send_bytes: Sends bytes to the vehicle. The connection sets it.
        on_message: Called with each message of the autopilot.
        on_bytes: Called with all bytes of the vehicle, to forward them.
        last_output: Returns the last output of the autopilot's program, if known.
    """

    def __init__(self, name: str) -> None:
        """Create a link without a connection. `name` is that of the vehicle, for messages."""
        self.name = name
        self.latest: dict[str, Message] = {}
        self.texts: deque[str] = deque(maxlen=_TEXTS_KEPT)
        self.lost: str | None = None
        self.send_bytes: Callable[[bytes], None] = _discard
        self.on_message: Callable[[Message], None] = _discard
        self.on_bytes: Callable[[bytes], None] = _discard
        self.last_output: Callable[[], str] = str
        self._dialect = load_dialect()
        self._codec = self._dialect.MAVLink(None, srcSystem=_GROUND_STATION, srcComponent=_MISSION_PLANNER)
        self._codec.robust_parsing = True
        self._source: tuple[int, int] | None = None
        self._waiting: dict[asyncio.Future[Message], Callable[[Message], bool]] = {}

    @property
    def target(self) -> tuple[int, int]:
        """System and component id of the autopilot. (0, 0), all systems, before its first HEARTBEAT."""
        return self._source or (0, 0)

    def send(self, message: Message) -> None:
        """Send a message. Raise SitlError if the link is lost."""
        if self.lost is not None:
            raise SitlError(f"{self.name}: {self.lost}")
        self.send_bytes(message.pack(self._codec))

    def feed(self, data: bytes) -> None:
        """Handle bytes of the vehicle: whole messages or parts of them."""
        self.on_bytes(data)
        for message in self._codec.parse_buffer(data) or ():
            if self._is_of_the_autopilot(message):
                self._take(message)

    def lose(self, reason: str) -> None:
        """Mark the link as lost. Tasks that wait for a message get a SitlError."""
        if self.lost is not None:
            return
        self.lost = reason
        for future in self._waiting:
            if not future.done():
                future.set_exception(SitlError(f"{self.name}: {reason}"))

    async def wait_for(self, accept: Callable[[Message], bool], timeout_s: float | None) -> Message | None:
        """Return the next message that `accept` accepts, or None after `timeout_s` (None: no limit).

        Raise SitlError if the link is lost.
        """
        if self.lost is not None:
            raise SitlError(f"{self.name}: {self.lost}")
        future: asyncio.Future[Message] = asyncio.get_running_loop().create_future()
        self._waiting[future] = accept
        try:
            return await asyncio.wait_for(future, timeout_s)
        except TimeoutError:
            return None
        finally:
            del self._waiting[future]

    def _is_of_the_autopilot(self, message: Message) -> bool:
        """Whether a message comes from the autopilot, not from a camera or another ground station."""
        kind = message.get_type()
        if kind == "BAD_DATA":
            return False
        source = (message.get_srcSystem(), message.get_srcComponent())
        if self._source is None:
            if kind != "HEARTBEAT" or message.autopilot == self._dialect.MAV_AUTOPILOT_INVALID:
                return False
            self._source = source
        return source == self._source

    def _take(self, message: Message) -> None:
        kind = message.get_type()
        self.latest[kind] = message
        if kind == "STATUSTEXT":
            self.texts.append(message.text)
        self.on_message(message)
        for future, accept in list(self._waiting.items()):
            if not future.done() and accept(message):
                future.set_result(message)


def _discard(_: Any) -> None:
    return
