"""`gradysim view` ends soon after a signal, whatever its viewers do, and leaves nothing behind."""

import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest
from websockets.sync.client import ClientConnection, connect

from gradysim.replay.chunk import unpack
from python.cli.command import environment
from python.processes import session, wait_until
from python.thorough import some
from python.viewing import silent_viewer

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="it looks into /proc")

ENDS_WITHIN_S = 2.0
"""Usually 0.3 s; 0.8 s with a viewer that does not answer, 1.4 s with a protocol that does not return."""

PAUSE = '{"time_s": 0, "speed": 0}'
LEAD_NS = 2e9
"""How far the run is ahead of a viewer that has paused at 0 s when it waits."""

PROTOCOLS = """
import time
from protocol import Endless

class Building(Endless):
    def __init__(self):
        open("ready", "w").close()
        time.sleep(1000)

class Stuck(Endless):
    def handle_timer(self, timer):
        open("ready", "w").close()
        time.sleep(1000)
    def finish(self):
        while True: pass
"""

ASLEEP = """
import sys
from python.cli.test_view_ends import paused

with paused(sys.argv[1]) as connection:
    print("paused", flush=True)
    for _ in connection:
        pass
"""

View = subprocess.Popen[str]
Begin = Callable[..., View]
Viewer = contextlib.AbstractContextManager[ClientConnection | None]


@pytest.fixture
def begin(folder: Path) -> Iterator[Begin]:
    """`begin(*arguments)`: `gradysim view` in its own session, with a directory for temporary files."""
    (folder / "endings.py").write_text(PROTOCOLS)
    (folder / "temporary").mkdir()
    begun = []

    def begin(*arguments: str) -> View:
        process = subprocess.Popen(
            [sys.executable, "-m", "gradysim", "view", *arguments, "--no-browser"],
            cwd=folder,
            env={**environment(), "TMPDIR": str(folder / "temporary")},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        begun.append(process)
        return process

    yield begin
    for process in begun:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


def address_of(view: View) -> str:
    """Return the address that a view prints when its server listens."""
    assert view.stdout is not None
    return view.stdout.readline().strip()


@contextlib.contextmanager
def viewer(address: str, clock: str) -> Iterator[ClientConnection]:
    """A viewer that has told its clock. The run has begun, and is ahead of a viewer that has paused."""
    url = urlsplit(address)
    with connect(f"ws://{url.netloc}/chunks?{url.query}", max_size=None) as connection:
        connection.send(clock)
        while (
            not isinstance(message := connection.recv(timeout=30), bytes) or unpack(message).end_ns < LEAD_NS
        ):
            pass
        yield connection


@contextlib.contextmanager
def nobody(_address: str) -> Iterator[None]:
    yield


def playing(address: str) -> Viewer:
    return viewer(address, '{"time_s": 1e9, "speed": 1}')


def paused(address: str) -> Viewer:
    return viewer(address, PAUSE)


@contextlib.contextmanager
def asleep(address: str) -> Iterator[None]:
    """A viewer that has paused, whose process does not run any more; as a browser on a laptop that sleeps."""
    command = [sys.executable, "-c", ASLEEP, address]
    with subprocess.Popen(command, env=environment(), stdout=subprocess.PIPE, text=True) as process:
        try:
            assert address_of(process) == "paused"
            process.send_signal(signal.SIGSTOP)
            yield
        finally:
            process.kill()


@contextlib.contextmanager
def gone(address: str) -> Iterator[None]:
    """A viewer that has paused, and whose network is gone."""
    with silent_viewer(address, PAUSE):
        with paused(address):
            pass
        yield


@contextlib.contextmanager
def at_the_end(address: str) -> Iterator[ClientConnection]:
    """A viewer that stays when the run has ended."""
    with playing(address) as connection:
        assert end_told_to(connection)["complete"]
        yield connection


def end_told_to(connection: ClientConnection) -> dict[str, Any]:
    """Return how the run ended, in the words of the last message to a viewer."""
    while True:
        message = connection.recv(timeout=30)
        if isinstance(message, str) and "end" in (content := json.loads(message)):
            return content["end"]


STATES: dict[str, tuple[tuple[str, ...], Callable[[str], Viewer]]] = {
    "waiting for a viewer": ((), nobody),
    "running": (("-c", "Endless"), playing),
    "paused": (("-c", "Endless"), paused),
    "asleep": (("-c", "Endless"), asleep),
    "gone": (("-c", "Endless"), gone),
    "ended": ((), at_the_end),
}
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def assert_ends(view: View, number: int) -> None:
    """Send a signal to a view, and check that it ends at once and leaves nothing behind."""
    began = time.monotonic()
    view.send_signal(number)
    assert view.wait(20) == 128 + number
    assert time.monotonic() - began < ENDS_WITHIN_S
    assert session(view.pid) == []
    assert "Traceback" not in view.communicate()[1]


@pytest.mark.parametrize("number", some(SIGNALS))
def test_while_it_is_built(begin, folder, number):
    view = begin("test.ini", "--mode", "prototype", "--set", '*.uavs[*].protocol.class="endings.py:Building"')
    wait_until((folder / "ready").exists)
    assert_ends(view, number)
    assert list((folder / "temporary").iterdir()) == []


@pytest.mark.parametrize("number", some(SIGNALS))
def test_in_a_callback_that_does_not_return(begin, folder, number):
    view = begin("test.ini", "--mode", "prototype", "--set", '*.uavs[*].protocol.class="endings.py:Stuck"')
    url = urlsplit(address_of(view))
    with connect(f"ws://{url.netloc}/chunks?{url.query}"):
        wait_until((folder / "ready").exists)
        assert_ends(view, number)


@pytest.mark.parametrize(
    ("state", "number"),
    [
        pytest.param(state, number, marks=[] if index % 3 == place % 3 else pytest.mark.verify)
        for place, state in enumerate(STATES)
        for index, number in enumerate(SIGNALS)
    ],
)
def test_it_ends_whatever_its_viewers_do(begin, folder, state, number):
    arguments, watch = STATES[state]
    view = begin("test.ini", "--mode", "prototype", *arguments)
    address = address_of(view)
    with watch(address) as connection:
        assert_ends(view, number)
        if state in ("running", "paused"):
            assert not end_told_to(connection)["complete"]
    assert list((folder / "temporary").iterdir()) == []
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection((urlsplit(address).hostname, urlsplit(address).port))
