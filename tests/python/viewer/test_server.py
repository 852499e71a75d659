"""The server of a page, with real connections."""

import errno
import socket
import threading
import time
from contextlib import ExitStack
from urllib.parse import urlsplit

import pytest
from websockets.sync.client import connect

from gradysim.viewer import server as server_module
from gradysim.viewer.connection import MOST_UNFINISHED
from gradysim.viewer.server import PageServer
from python.processes import wait_until
from python.viewing import silent_viewer

NEVER = bool
"""A `should_stop` that returns False."""

ENDS_WITHIN_S = 1.5
"""Half a second, and more on a busy machine."""


class Flood(PageServer):
    """Sends more than the buffers of a connection hold."""

    async def _write(self, viewer):
        while not viewer.leaving:
            await viewer.send(b"x" * 10_000_000)


@pytest.fixture
def page():
    with PageServer("127.0.0.1", 0, needs_token=True) as server:
        yield server


def ask(server, path):
    """Return the response to a request."""
    with socket.create_connection(("127.0.0.1", server.port)) as connection:
        connection.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        return connection.recv(1000).decode()


def join(server, **options):
    url = urlsplit(server.address)
    return connect(f"ws://{url.netloc}/?{url.query}", close_timeout=0.1, **options)


@pytest.mark.parametrize("port", [-1, 65536, 80000])
def test_what_is_not_a_port_is_refused(port):
    with pytest.raises(ValueError, match=f"{port}: .* 0 to 65535"):
        PageServer("127.0.0.1", port)


@pytest.mark.parametrize(
    ("host", "number"),
    [
        ("127.0.0.1", errno.EADDRINUSE),
        ("192.0.2.1", errno.EADDRNOTAVAIL),
        ("no.such.invalid", socket.EAI_NONAME),
    ],
)
def test_an_address_that_cannot_be_used_is_named(page, host, number):
    with pytest.raises(OSError, match=host) as refused, PageServer(host, page.port):
        pass
    assert refused.value.errno == number
    assert refused.value.filename == f"{host} port {page.port}"


@pytest.mark.parametrize("path", ["//[x?token", "//[x", "/?token=%ff", "*", "/?pass=", "/?pass=x"])
def test_a_malformed_request_is_refused(page, path):
    assert ask(page, path).startswith("HTTP/1.1 403 ")


def test_the_address_for_a_browser_leads_to_the_page_once(page):
    url = urlsplit(page.address_for_once)
    first, second = (ask(page, f"/?{url.query}") for _ in range(2))
    assert first.startswith("HTTP/1.1 303 ")
    assert f"Location: /?{urlsplit(page.address).query}\r\n" in first
    assert second.startswith("HTTP/1.1 403 ")


def test_connections_that_never_finish_their_handshake_are_few(page):
    with ExitStack() as stack:
        silent = [
            stack.enter_context(socket.create_connection(("127.0.0.1", page.port)))
            for _ in range(MOST_UNFINISHED + 100)
        ]
        for connection in silent[:100]:
            connection.settimeout(30)
            assert connection.recv(1) == b""
        wait_until(lambda: len(page._connections) == MOST_UNFINISHED)
        assert threading.active_count() < 10
        with join(page):
            page.wait_for_viewer(NEVER)


def test_a_viewer_that_does_not_answer_is_dropped(page, monkeypatch):
    monkeypatch.setattr(server_module, "_PONG_S", 1.0)
    monkeypatch.setattr(server_module, "_PING_S", 0.1)
    with PageServer("127.0.0.1", 0) as page, join(page) as lively, silent_viewer(page.address):
        wait_until(lambda: page.viewers == 2)
        wait_until(lambda: page.viewers == 1)
        assert lively.ping().wait(30)


def test_it_ends_at_once_though_viewers_do_not_read():
    with Flood("127.0.0.1", 0) as page, ExitStack() as viewers:
        for _ in range(3):
            viewers.enter_context(join(page, max_queue=1, max_size=None))
        wait_until(
            lambda: all(viewer.connection.transport.get_write_buffer_size() for viewer in page._viewers)
        )
        began = time.monotonic()
        page.stop()
        assert time.monotonic() - began < ENDS_WITHIN_S
