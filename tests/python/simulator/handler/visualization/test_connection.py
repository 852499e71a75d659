"""The connection to a viewer, tested with a real one."""

import functools
import random
import time

import websockets.asyncio.server
from websockets.sync.client import connect

from gradysim.simulator.handler.visualization import VisualizationConfiguration
from gradysim.simulator.handler.visualization.messages import CommandQueue
from gradysim.simulator.handler.visualization.server import VisualizationServer


def test_looking_for_lost_viewers_draws_no_random_number_of_the_run(monkeypatch):
    impatient = functools.partial(websockets.asyncio.server.serve, ping_interval=0.001)
    monkeypatch.setattr(websockets.asyncio.server, "serve", impatient)
    server = VisualizationServer(
        VisualizationConfiguration(host="127.0.0.1", port=0), "hello", CommandQueue()
    )
    server.start()
    state = random.getstate()
    with connect(f"ws://127.0.0.1:{server.port}") as viewer:
        viewer.recv(timeout=30)
        (connection,) = [viewer.connection for viewer in server._viewers]
        deadline = time.monotonic() + 30
        while connection.latency == 0 and time.monotonic() < deadline:
            time.sleep(0.001)
        assert connection.latency > 0  # it has answered
    server.stop()
    assert random.getstate() == state
