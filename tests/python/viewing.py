"""Viewers of `gradysim view` that replace a browser."""

import contextlib
import json
import shlex
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import SplitResult, urlsplit

from websockets.sync.client import connect


@contextlib.contextmanager
def silent_viewer(address: str, message: str = "") -> Iterator[None]:
    """A viewer that sends a message, then neither reads nor answers; as one whose network is gone."""
    url = urlsplit(address)
    upgrade = ("Connection: Upgrade", "Upgrade: websocket", "Sec-WebSocket-Version: 13")
    key = "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA=="
    request = [f"GET /chunks?{url.query} HTTP/1.1", f"Host: {url.netloc}", *upgrade, key, "", ""]
    frame = bytes([0x81, 0x80 | len(message), 0, 0, 0, 0]) + message.encode()  # text, masked with zeros
    with socket.create_connection((url.hostname, url.port)) as connection:
        connection.sendall("\r\n".join(request).encode() + frame)
        assert connection.recv(12) == b"HTTP/1.1 101"
        yield


@contextlib.contextmanager
def _serving(command: str, folder: Path, **options: Any) -> Iterator[subprocess.Popen[str]]:
    """`gradysim view`, which is killed if a test fails, since it would wait for a viewer for ever."""
    arguments = [*shlex.split(command)[1:], "--no-browser"]
    with subprocess.Popen(
        [sys.executable, "-m", "gradysim", *arguments],
        cwd=folder,
        stdout=subprocess.PIPE,
        text=True,
        **options,
    ) as process:
        try:
            yield process
        except BaseException:
            process.kill()
            raise


def _address(process: subprocess.Popen[str]) -> SplitResult:
    assert process.stdout is not None
    return urlsplit(process.stdout.readline().strip())


def visited(command: str, folder: Path) -> int:
    """Open the page of `gradysim view` of several replays, leave it, and return the exit code."""
    with _serving(command, folder) as process:
        address = _address(process)
        with connect(f"ws://{address.netloc}/viewer?{address.query}"):
            pass
        return process.wait(20)


def watched(command: str, folder: Path, **options: Any) -> tuple[dict[str, Any], int, str]:
    """Return the final message of the run of `gradysim view FILE.ini ...`, exit code and error output."""
    with _serving(command, folder, stderr=subprocess.PIPE, **options) as process:
        assert process.stderr is not None
        address = _address(process)
        with connect(f"ws://{address.netloc}/chunks?{address.query}", max_size=None) as viewer:
            ends = (json.loads(message).get("end") for message in viewer if isinstance(message, str))
            end = next(filter(None, ends))
        error_output = process.stderr.read()
        return end, process.wait(20), error_output
