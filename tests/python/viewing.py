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
from urllib.parse import urlsplit

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


def visited(command: str, folder: Path) -> int:
    """Open the page of `gradysim view` of several replays, leave it, and return the exit code."""
    arguments = [*shlex.split(command)[1:], "--no-browser"]
    program = [sys.executable, "-m", "gradysim", *arguments]
    with subprocess.Popen(program, cwd=folder, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        address = urlsplit(process.stdout.readline().strip())
        with connect(f"ws://{address.netloc}/viewer?{address.query}"):
            pass
        return process.wait(20)


def watched(command: str, folder: Path, **options: Any) -> tuple[dict[str, Any], int, str]:
    """Return the final message of the run of `gradysim view FILE.ini ...`, exit code and error output."""
    arguments = [*shlex.split(command)[1:], "--no-browser"]
    with subprocess.Popen(
        [sys.executable, "-m", "gradysim", *arguments],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        address = urlsplit(process.stdout.readline().strip())
        with connect(f"ws://{address.netloc}/chunks?{address.query}", max_size=None) as viewer:
            ends = (json.loads(message).get("end") for message in viewer if isinstance(message, str))
            end = next(filter(None, ends))
        error_output = process.stderr.read()
        return end, process.wait(20), error_output
