"""The connection to a viewer, tested with a real one."""

import random

from websockets.sync.client import connect

from gradysim.viewer import server
from gradysim.viewer.server import PageServer
from python.processes import wait_until


def test_looking_for_lost_viewers_draws_no_random_number_of_the_run(monkeypatch):
    monkeypatch.setattr(server, "_PING_S", 0.001)
    with PageServer("127.0.0.1", 0) as page, connect(f"ws://127.0.0.1:{page.port}"):
        state = random.getstate()
        page.wait_for_viewer(lambda: False)
        (viewer,) = page._viewers
        wait_until(lambda: viewer.connection.latency > 0)  # it has answered
        assert random.getstate() == state
