"""HTTP of the servers of the page: which requests they accept, and their responses."""

import logging
from collections.abc import Collection
from http import HTTPStatus
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from websockets.http11 import Request, Response

LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "[::1]"})
"""Names in addresses that only this machine can reach."""

_WILDCARDS = frozenset({"", "0.0.0.0", "[::]"})
"""Hosts that stand for all addresses of this machine."""

_REASONS = {
    HTTPStatus.FORBIDDEN: "Open the address that the program printed.",
    HTTPStatus.NOT_FOUND: "There is nothing here.",
    HTTPStatus.SEE_OTHER: "The page is at another address.",
}


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


def silent_logger(name: str) -> logging.Logger:
    """Return a logger for the library, which logs each handshake that fails."""
    logger = logging.getLogger(f"{name}.websockets")
    logger.setLevel(logging.CRITICAL + 1)
    return logger


def respond(connection: Any, status: HTTPStatus, location: str | None = None) -> "Response":
    """Return the response to a request that gets no page; `location` is where it finds one.

    `connection` is a `ServerConnection` of `websockets`.
    """
    response: Response = connection.respond(status, f"{_REASONS[status]}\n")
    if location is not None:
        response.headers["Location"] = location
    return response


def respond_with_page(connection: Any, page: bytes, *, is_sandboxed: bool = False) -> "Response":
    """Return the response that holds a page.

    If it is sandboxed, its scripts cannot reach the other pages of the server: it may be a file of others.
    """
    response: Response = connection.respond(HTTPStatus.OK, "")
    response.body = page
    for name, value in (("Content-Type", "text/html; charset=utf-8"), ("Content-Length", str(len(page)))):
        del response.headers[name]
        response.headers[name] = value
    if is_sandboxed:
        response.headers["Content-Security-Policy"] = "sandbox allow-scripts allow-downloads"
    return response
