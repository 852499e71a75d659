import subprocess
import sys

import pytest
from websockets.sync.client import connect

from gradysim.simulator.handler.visualization import VisualizationConfiguration
from gradysim.simulator.handler.visualization.messages import CommandQueue
from gradysim.simulator.handler.visualization.server import VisualizationServer, _Viewer


@pytest.fixture
def commands():
    return CommandQueue()


@pytest.fixture
def server(commands):
    configuration = VisualizationConfiguration(host="127.0.0.1", port=0, update_rate=0.001)
    server = VisualizationServer(configuration, "hello", commands)
    server.start()
    yield server
    server.stop()


def url(server):
    return f"ws://127.0.0.1:{server.port}"


def test_a_viewer_is_greeted_and_told_the_news(server):
    with connect(url(server)) as viewer:
        greeting = viewer.recv(timeout=30)
        server.publish("news")
        assert (greeting, viewer.recv(timeout=30)) == ("hello", "news")


def test_the_same_news_is_told_once(commands):
    server = VisualizationServer(VisualizationConfiguration(), "hello", commands)
    viewer = _Viewer(connection=None)
    server._viewers[viewer] = None
    server.publish("news")
    told = []
    for _ in range(2):
        server._update()
        told.append(viewer.snapshot)
        viewer.snapshot = None
    assert told == ["news", None]


def test_who_comes_later_is_told_the_last_news(server):
    with connect(url(server)) as first:
        server.publish("news")
        first.recv(timeout=30), first.recv(timeout=30)
        with connect(url(server)) as second:
            assert [second.recv(timeout=30), second.recv(timeout=30)] == ["hello", "news"]


def test_a_viewer_may_leave(server):
    with connect(url(server)) as first:
        first.recv(timeout=30)
    with connect(url(server)) as second:
        second.recv(timeout=30)
        server.publish("news")
        assert second.recv(timeout=30) == "news"


def test_the_last_news_and_commands_arrive_before_the_end(server, commands):
    with connect(url(server)) as viewer:
        viewer.recv(timeout=30)
        commands.put({"command": "resize_nodes", "payload": {"size": 1}})
        server.publish("the end")
        server.stop()
        assert set(viewer) == {"the end", '{"command": "resize_nodes", "payload": {"size": 1}}'}


def test_a_slow_viewer_misses_snapshots_but_no_command(server, commands):
    with connect(url(server), max_queue=1) as viewer:
        viewer.recv(timeout=30)
        for number in range(50):
            commands.put({"command": "resize_nodes", "payload": {"size": number}})
            server.publish(f"{number} {'x' * 1_000_000}")
            server._wanted.wait(30)
        server.publish("the end")
        messages = []
        while (message := viewer.recv(timeout=30)) != "the end":
            messages.append(message)
    sizes = [message for message in messages if message.startswith("{")]
    assert len(sizes) == 50
    assert len(messages) - len(sizes) < 50


def test_it_asks_for_a_snapshot_when_it_took_the_last(server):
    server._wanted.wait(30)
    assert server.wants_snapshot


def test_stopping_twice_does_nothing(server):
    server.stop()
    server.stop()


def test_stopping_what_never_started_does_nothing(commands):
    VisualizationServer(VisualizationConfiguration(), "hello", commands).stop()


def test_nobody_is_paused_at_first(server):
    assert not server.is_paused
    server.wait_while_paused()


def test_the_library_is_imported_only_by_who_starts_a_server():
    program = "import sys; sys.modules['websockets'] = None; import gradysim.simulator.handler.visualization"
    subprocess.run([sys.executable, "-c", program], check=True, env={"PYTHONPATH": ":".join(sys.path)})


def test_a_failure_of_the_server_ends_a_pause_and_is_told(commands, monkeypatch, caplog):
    async def fail():
        server._started.set_result(0)
        raise ArithmeticError

    server = VisualizationServer(VisualizationConfiguration(), "hello", commands)
    monkeypatch.setattr(server, "_serve", fail)
    server._running.clear()
    server._run()
    assert (server.is_paused, len(caplog.messages)) == (False, 1)
    assert "the simulation goes on without it" in caplog.text
