"""Hostile viewers of a run: it ends, if need be by a signal, with the same result, and leaves no thread."""

import contextlib
import faulthandler
import logging
import os
import signal
import socket
import threading
import time
from collections.abc import Callable
from pathlib import Path
from random import Random
from urllib.parse import urlsplit

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.prototype.run import PrototypeRun
from gradysim.replay.live import LiveView
from gradysim.results.result import RunResult
from gradysim.scenario import Scenario, load_scenarios
from gradysim.simulator.handler.visualization import VisualizationConfiguration, VisualizationHandler

_INI = """
[General]
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

_END_S = 60.0
"""Time limit for a run that takes seconds without viewers, in seconds of wall time."""

_PATIENCE_S = 1.0
"""Wall time for clients to leave, after which a run that waits for them is ended, in seconds."""

_ENDS_WITHIN_S = 3.0
"""Wall time from SIGTERM to the end of the run, in seconds; usually 0.4."""

MESSAGES = (
    '{"interaction": "pause/resume"}',
    '{"time_s": 0, "speed": 0}',
    '{"time_s": "soon", "speed": []}',
    "[" * 900,
    "x" * 5000,
    "\x00",
)


class Client:
    """A hostile connection, which stays until `leave`."""

    def __init__(self, random: Random, address: str) -> None:
        url = urlsplit(address)
        self._stack = contextlib.ExitStack()
        with contextlib.suppress(OSError, WebSocketException):  # the run may have ended, or reject it
            if random.random() < 0.5:
                self._raw(random, str(url.hostname), url.port or 0)
            else:
                self._viewer(random, f"ws://{url.netloc}{url.path}?{url.query}")

    def _raw(self, random: Random, host: str, port: int) -> None:
        connection = self._stack.enter_context(socket.create_connection((host, port), timeout=2))
        request = f"GET {random.choice(['/', '/chunks', '//[x'])} HTTP/1.1\r\nHost: {host}:{port}\r\n\r\n"
        connection.sendall(random.choice([b"", request.encode(), random.randbytes(3000)]))

    def _viewer(self, random: Random, url: str) -> None:
        viewer = self._stack.enter_context(connect(url, open_timeout=5, close_timeout=0.1, max_queue=1))
        for _ in range(random.randrange(4)):
            viewer.send(random.choice(MESSAGES))
        if random.random() < 0.3:
            viewer.socket.shutdown(socket.SHUT_RDWR)

    def leave(self) -> None:
        """Close the connection, if there is one."""
        with contextlib.suppress(OSError, WebSocketException):
            self._stack.close()


class Siege(threading.Thread):
    """Clients that come and go while a run is executed. Those that have paused it do not leave.

    Attributes:
        count: Number of clients.
        ended_at: When SIGTERM was sent, since the run waited; None if it ended by itself.
    """

    def __init__(self, random: Random, address: Callable[[], str]) -> None:
        super().__init__(daemon=True)
        self.count = random.randint(5, 20)
        self.ended_at: float | None = None
        self._random = random
        self._address = address
        self._clients: list[Client] = []
        self._run_has_ended = threading.Event()
        self._ending = threading.Lock()

    def run(self) -> None:
        """Connect all clients, then end the run if it does not end."""
        with contextlib.suppress(LookupError):  # it has ended
            for _ in range(self.count):
                self._clients.append(Client(self._random, self._address()))
                if self._random.random() < 0.3:
                    self._clients.pop(self._random.randrange(len(self._clients))).leave()
        if not self._run_has_ended.wait(_PATIENCE_S):
            with self._ending:
                if not self._run_has_ended.is_set():
                    self.ended_at = time.monotonic()
                    os.kill(os.getpid(), signal.SIGTERM)

    def end(self) -> None:
        """Say that the run has ended, so that no signal is sent from now on."""
        with self._ending:
            self._run_has_ended.set()

    def leave(self) -> None:
        """Close all connections."""
        self.join()
        for client in self._clients:
            client.leave()


def besieged(
    random: Random,
    run: PrototypeRun,
    address: Callable[[], str],
    paced: Callable[[Callable[[], bool]], Callable[[], bool]] = lambda should_stop: should_stop,
) -> int:
    """Run in this thread, as `gradysim view` does, while clients connect and leave; return their number."""
    siege = Siege(random, address)
    faulthandler.dump_traceback_later(_END_S, exit=True)  # if it does not end
    try:
        with StopOnInterrupt() as interrupt:
            siege.start()
            with interrupt.executing():
                run.execute(should_stop=paced(interrupt.should_stop))
            siege.end()
    except KeyboardInterrupt:
        pass
    finally:
        siege.end()
        faulthandler.cancel_dump_traceback_later()
    if siege.ended_at is not None:
        assert time.monotonic() - siege.ended_at < _ENDS_WITHIN_S, "the run has not ended soon"
    siege.leave()
    return siege.count


def once(random: Random, folder: Path) -> int:
    """Show a run to hostile viewers; return their number."""
    (folder / "talker.py").write_text(_PROTOCOL)
    (folder / "talk.ini").write_text(_INI)
    threads = threading.active_count()
    watch, duration = random.choice([(watched_live, "6s"), (watched_by_handler, "2s")])
    (scenario,) = load_scenarios(folder / "talk.ini", overrides=[f"sim-time-limit={duration}"])
    undisturbed = PrototypeRun(scenario)
    undisturbed.execute()
    count, result = watch(random, scenario)
    assert_agrees(result, undisturbed.result())
    end_s = time.monotonic() + _END_S
    while threading.active_count() > threads:
        assert time.monotonic() < end_s, "a thread is left"
        time.sleep(0.01)
    return count


def assert_agrees(result: RunResult, undisturbed: RunResult) -> None:
    """Check that a run is the same, or its beginning if it was ended."""
    if not result.interrupted:
        assert result.outcomes == undisturbed.outcomes
        assert [node.position for node in result.nodes] == [node.position for node in undisturbed.nodes]
        return
    for kind, outcomes in result.outcomes["frames"].items():
        in_full = undisturbed.outcomes["frames"][kind]
        assert all(count <= in_full[outcome] for outcome, count in outcomes.items() if outcome != "in_air")


def watched_live(random: Random, scenario: Scenario) -> tuple[int, RunResult]:
    """Serve it like `gradysim view`."""
    with LiveView() as view:
        run = PrototypeRun(scenario, replay=view)
        count = besieged(random, run, lambda: view.address.replace("/?", "/chunks?"), view.paced)
    return count, run.result()


def watched_by_handler(random: Random, scenario: Scenario) -> tuple[int, RunResult]:
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
