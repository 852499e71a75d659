"""What the servers of the page have in common: which requests they accept, and how they answer.

The package `websockets` is imported by the servers only.
"""

import logging
from collections.abc import Callable, Collection
from http import HTTPStatus
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

if TYPE_CHECKING:
    from websockets.http11 import Request, Response

LONGEST_MESSAGE_BYTES = 1000
"""Limit for messages from a viewer."""

HANDSHAKE_S = 2.0
"""Time limit for the opening handshake of a viewer, in seconds of wall time."""

LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "[::1]"})
"""Names in addresses that only this machine can reach."""

_WILDCARDS = frozenset({"", "0.0.0.0", "[::]"})
"""Hosts that stand for all addresses of this machine."""


class Host:
    """The host that a server listens on.

    Attributes:
        name: How the address of the page names it, for browsers on this machine.
        accepted: Names that the header `Host` of a request may have; None for any.
    """

    def __init__(self, host: str) -> None:
        """Take a name or an address, such as `localhost`, `0.0.0.0` or `::1`."""
        written = f"[{host}]" if ":" in host else host
        self.name = "localhost" if written in _WILDCARDS else written
        self.accepted = LOOPBACK_NAMES if written in LOOPBACK_NAMES else None


def is_allowed(
    request: "Request",
    names: Collection[str] | None = LOOPBACK_NAMES,
    origins: Collection[str] = (),
) -> bool:
    """Return whether a server may answer a request.

    Pages of other sites must not reach the server. The browser names their site in `Origin`. If they use a
    name of their own for this machine (DNS rebinding), `Host` has that name. Scripts send no `Origin`.

    Args:
        request: The HTTP request.
        names: Names that `Host` may have; None for any.
        origins: Sites that may connect, besides the server's own page.
    """
    host = request.headers.get("Host", "")
    has_own_name = names is None or host.rsplit(":", 1)[0] in names
    return has_own_name and request.headers.get("Origin") in {None, f"http://{host}", *origins}


def answer(connection: Any, request: "Request", allowed: bool, page: Callable[[], str]) -> "Response | None":
    """Return the answer to a request: the page at `/`, or an error; None if it opens the WebSocket.

    `connection` is a `ServerConnection` of `websockets.sync` or `websockets.asyncio`.
    """
    if not allowed:
        return _respond(connection, HTTPStatus.FORBIDDEN, "Open the address that the program printed.\n")
    if "Upgrade" in request.headers:
        return None
    if urlsplit(request.path).path != "/":
        return _respond(connection, HTTPStatus.NOT_FOUND, "There is nothing here.\n")
    response = _respond(connection, HTTPStatus.OK, page())
    del response.headers["Content-Type"]
    response.headers["Content-Type"] = "text/html; charset=utf-8"
    return response


def silent_logger(name: str) -> logging.Logger:
    """Return a logger for the library, which logs each handshake that fails."""
    logger = logging.getLogger(f"{name}.websockets")
    logger.setLevel(logging.CRITICAL + 1)
    return logger


def _respond(connection: Any, status: HTTPStatus, text: str) -> "Response":
    response: Response = connection.respond(status, text)
    return response
