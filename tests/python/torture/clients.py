"""Hostile viewers of a run: it still ends, with the same result, and leaves no thread."""

import contextlib
import logging
import socket
import threading
import time
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any
from urllib.parse import urlsplit

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

from gradysim.prototype.run import PrototypeRun
from gradysim.replay.live import LiveView
from gradysim.scenario import load_scenarios
from gradysim.simulator.handler.visualization import VisualizationConfiguration, VisualizationHandler

_INI = """
[General]
sim-time-limit = 2s
*.numNodes = 5
*.nodes[*].protocol.class = "talker.py:Talker"
*.nodes[*].mobility.typename = "StationaryMobility"
"""

_PROTOCOL = """
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand

class Talker(IProtocol):
    def initialize(self):
        self.handle_timer("talk")

    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))
        self.provider.schedule_timer("talk", self.provider.current_time() + 0.01)

    def handle_packet(self, message): ...
    def handle_telemetry(self, telemetry): ...
    def finish(self): ...
"""

_END_S = 30.0
"""Time limit for a run that takes a tenth of a second without viewers, in seconds of wall time."""

MESSAGES = (
    '{"interaction": "pause/resume"}',
    '{"time_s": 0, "speed": 0}',
    '{"time_s": "soon", "speed": []}',
    "[" * 900,
    "x" * 5000,
    "\x00",
)


class Client:
    """A hostile connection, which stays until `leave`.

    Attributes:
        may_stay: Whether the run ends while it is connected; false if it has paused the run.
    """

    def __init__(self, random: Random, address: str) -> None:
        url = urlsplit(address)
        self.may_stay = True
        self._stack = contextlib.ExitStack()
        with contextlib.suppress(OSError, WebSocketException):  # the run may have ended, or reject it
            if random.random() < 0.5:
                self._raw(random, str(url.hostname), url.port or 0)
            else:
                self._viewer(random, f"ws://{url.netloc}{url.path}?{url.query}")

    def _raw(self, random: Random, host: str, port: int) -> None:
        connection = self._stack.enter_context(socket.create_connection((host, port), timeout=2))
        request = f"GET {random.choice(['/', '/chunks', '/../x'])} HTTP/1.1\r\nHost: {host}:{port}\r\n\r\n"
        connection.sendall(random.choice([b"", request.encode(), random.randbytes(3000)]))

    def _viewer(self, random: Random, url: str) -> None:
        viewer = self._stack.enter_context(connect(url, open_timeout=5, close_timeout=0.1, max_queue=1))
        for _ in range(random.randrange(4)):
            self.may_stay = False
            viewer.send(random.choice(MESSAGES))
        if random.random() < 0.3:
            viewer.socket.shutdown(socket.SHUT_RDWR)

    def leave(self) -> None:
        """Close the connection, if there is one."""
        with contextlib.suppress(OSError, WebSocketException):
            self._stack.close()


def besieged(random: Random, run: PrototypeRun, address: Callable[[], str]) -> int:
    """Run while clients connect and leave; return their number."""
    thread = threading.Thread(target=run.execute, daemon=True)
    thread.start()
    clients: list[Client] = []
    count = random.randint(5, 20)
    for _ in range(count):
        with contextlib.suppress(LookupError):  # it has ended
            clients.append(Client(random, address()))
        if clients and random.random() < 0.3:
            clients.pop(random.randrange(len(clients))).leave()
    for client in clients:
        if not client.may_stay:
            client.leave()
    thread.join(_END_S)
    assert not thread.is_alive(), "the run has not ended"
    for client in clients:
        client.leave()
    return count


def once(random: Random, folder: Path) -> int:
    """Show a run to hostile viewers; return their number."""
    (folder / "talker.py").write_text(_PROTOCOL)
    (folder / "talk.ini").write_text(_INI)
    (scenario,) = load_scenarios(folder / "talk.ini")
    threads = threading.active_count()
    undisturbed = PrototypeRun(scenario)
    undisturbed.execute()
    count, result = random.choice([watched_live, watched_by_handler])(random, scenario)
    assert result.fingerprint == undisturbed.result().fingerprint
    end_s = time.monotonic() + _END_S
    while threading.active_count() > threads:
        assert time.monotonic() < end_s, "a thread is left"
        time.sleep(0.01)
    return count


def watched_live(random: Random, scenario: Any) -> tuple[int, Any]:
    """Serve it like `gradysim view`."""
    view = LiveView()
    try:
        run = PrototypeRun(scenario, replay=view)
        count = besieged(random, run, lambda: view.address.replace("/?", "/chunks?"))
    finally:
        view.stop()
    return count, run.result()


def watched_by_handler(random: Random, scenario: Any) -> tuple[int, Any]:
    """Serve it like a VisualizationHandler."""
    handler = VisualizationHandler(VisualizationConfiguration(host="127.0.0.1", port=0, update_rate=0.001))

    def address() -> str:
        for _ in range(1000):
            if handler.port:
                return f"http://127.0.0.1:{handler.port}/"
            time.sleep(0.001)
        raise LookupError("nobody listens")

    run = PrototypeRun(scenario, handlers=[handler], real_time=5, log_level=logging.ERROR)
    count = besieged(random, run, address)
    return count, run.result()
