"""Messages to and from one vehicle."""

import asyncio
from collections import deque
from collections.abc import Callable
from typing import Any

from gradysim.sitl.dialect import load_dialect
from gradysim.sitl.error import SitlError

Message = Any
"""A message of the dialect; `get_type()` is its name."""

_GROUND_STATION = 255
"""System id of a ground station by MAVLink's convention: the one whose orders vehicles obey."""

_MISSION_PLANNER = 190
"""Component id of a ground station's program."""

_TEXTS_KEPT = 8


class MavlinkLink:
    """One vehicle's messages, with a parser of its own; bytes come by `feed` and leave by `send_bytes`.

    Attributes:
        latest: The newest message of each type, by its name.
        texts: What the autopilot said lately, the newest last.
        lost: Why there will be no more messages; None while there may be.
        send_bytes: Takes what goes to the vehicle; set by who makes the connection.
        on_message: Called with each message of the autopilot.
        on_bytes: Called with all bytes that come, for who passes them on.
        last_words: Returns what the autopilot's program printed last, if somebody knows.
    """

    def __init__(self, name: str) -> None:
        """Make a link without a connection; `name` is the vehicle's, for people."""
        self.name = name
        self.latest: dict[str, Message] = {}
        self.texts: deque[str] = deque(maxlen=_TEXTS_KEPT)
        self.lost: str | None = None
        self.send_bytes: Callable[[bytes], None] = _discard
        self.on_message: Callable[[Message], None] = _discard
        self.on_bytes: Callable[[bytes], None] = _discard
        self.last_words: Callable[[], str] = str
        self._dialect = load_dialect()
        self._codec = self._dialect.MAVLink(None, srcSystem=_GROUND_STATION, srcComponent=_MISSION_PLANNER)
        self._codec.robust_parsing = True
        self._source: tuple[int, int] | None = None
        self._waiting: dict[asyncio.Future[Message], Callable[[Message], bool]] = {}

    @property
    def target(self) -> tuple[int, int]:
        """System and component id of the autopilot; (0, 0), everybody, before its first HEARTBEAT."""
        return self._source or (0, 0)

    def send(self, message: Message) -> None:
        """Send a message; SitlError if the link is lost."""
        if self.lost is not None:
            raise SitlError(f"{self.name}: {self.lost}")
        self.send_bytes(message.pack(self._codec))

    def feed(self, data: bytes) -> None:
        """Take bytes of the vehicle, whole messages or parts of them."""
        self.on_bytes(data)
        for message in self._codec.parse_buffer(data) or ():
            if self._is_of_the_autopilot(message):
                self._take(message)

    def lose(self, reason: str) -> None:
        """Say that nothing will come any more; who waits for a message gets a SitlError."""
        if self.lost is not None:
            return
        self.lost = reason
        for future in self._waiting:
            if not future.done():
                future.set_exception(SitlError(f"{self.name}: {reason}"))

    async def wait_for(self, accept: Callable[[Message], bool], timeout_s: float | None) -> Message | None:
        """Return the first message to come that is accepted; None if there is none in `timeout_s` s.

        Without a limit it waits for ever.

        Raises:
            SitlError: The link is lost.
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
