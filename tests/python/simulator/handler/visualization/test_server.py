import socket
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request
from contextlib import ExitStack, contextmanager

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from gradysim.simulator.handler.visualization import VisualizationConfiguration
from gradysim.simulator.handler.visualization.messages import CommandQueue
from gradysim.simulator.handler.visualization.server import PUBLIC_VIEWER, VisualizationServer, _Viewer
from gradysim.viewer import server as page_server
from gradysim.viewer.server import LONGEST_MESSAGE_BYTES


@pytest.fixture
def commands():
    return CommandQueue()


@contextmanager
def serving(commands, host="127.0.0.1"):
    configuration = VisualizationConfiguration(host=host, port=0, update_rate=0.001)
    server = VisualizationServer(configuration, "hello", commands)
    server.start()
    try:
        yield server
    finally:
        server.stop()


@pytest.fixture
def server(commands):
    with serving(commands) as server:
        yield server


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


def test_who_comes_later_gets_the_last_command_of_each_kind_and_node(server, commands):
    with connect(url(server)) as first:
        first.recv(timeout=30)
        for node_id, color in [(0, 1), (1, 2), (0, 3)]:
            payload = {"node_id": node_id, "color": color}
            commands.put({"command": "paint_node", "payload": payload})
            first.recv(timeout=30)
        with connect(url(server)) as second:
            assert [second.recv(timeout=30) for _ in range(3)] == [
                "hello",
                '{"command": "paint_node", "payload": {"node_id": 0, "color": 3}}',
                '{"command": "paint_node", "payload": {"node_id": 1, "color": 2}}',
            ]


def code_of(address, **headers):
    """Return the HTTP status of a GET request."""
    try:
        with urllib.request.urlopen(urllib.request.Request(address, headers=headers), timeout=30) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        error.close()
        return error.code


def test_the_page_is_at_the_address_and_nothing_beside_it(server):
    assert (code_of(server.address), code_of(server.address + "other")) == (200, 404)


@pytest.mark.parametrize("host", ["0.0.0.0", ""])
def test_if_it_listens_everywhere_the_address_is_that_of_this_machine(commands, host):
    with serving(commands, host) as server:
        assert server.address == f"http://localhost:{server.port}/"


def test_addresses_of_ipv6_are_in_brackets(commands):
    server = VisualizationServer(VisualizationConfiguration(host="fe80::1", port=1), "hello", commands)
    assert server.address == "http://[fe80::1]:1/"


@pytest.mark.parametrize("name", ["127.0.0.1", "localhost"])
def test_its_own_page_and_the_public_viewer_connect(server, name):
    for origin in (f"http://{name}:{server.port}", PUBLIC_VIEWER):
        with connect(f"ws://{name}:{server.port}", origin=origin) as viewer:
            assert viewer.recv(timeout=30) == "hello"


@pytest.mark.parametrize("origin", ["https://example.org", "http://localhost:1", "null"])
def test_no_other_page_connects(server, origin):
    with pytest.raises(InvalidStatus) as refused, connect(url(server), origin=origin):
        pass
    assert refused.value.response.status_code == 403


def test_another_name_of_this_machine_is_refused_unless_others_may_watch(commands):
    for host, code in (("127.0.0.1", 403), ("0.0.0.0", 200)):
        with serving(commands, host) as server:
            assert code_of(f"http://127.0.0.1:{server.port}/", Host=f"example.org:{server.port}") == code


def test_a_request_with_two_hosts_is_refused(server):
    with socket.create_connection(("127.0.0.1", server.port)) as connection:
        connection.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\nHost: example.org\r\n\r\n")
        assert b" 500 " in connection.recv(100)


def test_a_long_message_ends_the_connection(server):
    with connect(url(server)) as viewer:
        viewer.send("x" * LONGEST_MESSAGE_BYTES)
        assert viewer.recv(timeout=30) == "hello"
        viewer.send("x" * (LONGEST_MESSAGE_BYTES + 1))
        with pytest.raises(ConnectionClosed) as closed:
            viewer.recv(timeout=30)
    assert closed.value.rcvd.code == 1009


def never_reads(server):
    """Connect a viewer that does not read from its socket."""
    return connect(url(server), max_queue=1, max_size=None, close_timeout=0.1)


def fill_buffers(server):
    """Publish until the buffers of viewers that do not read are full."""
    for number in range(1000):
        server.publish(f"{number} {'x' * 2_000_000}")
        time.sleep(0.1)
        if all(viewer.snapshot is not None for viewer in list(server._viewers)):
            return
    raise AssertionError("somebody reads")


def test_a_viewer_that_pauses_and_never_reads_is_disconnected(server, monkeypatch):
    monkeypatch.setattr(page_server, "_MESSAGE_S", 0.2)
    with never_reads(server) as viewer:
        viewer.send('{"interaction": "pause/resume"}')
        while not server.is_paused:
            time.sleep(0.01)
        fill_buffers(server)
        assert server._running.wait(30)


@pytest.mark.verify
def test_a_hundred_clients_of_all_kinds_end_with_the_server(server):
    threads = threading.active_count()
    with ExitStack() as clients:
        for _ in range(25):
            clients.enter_context(socket.create_connection(("127.0.0.1", server.port)))  # sends nothing
            asks = clients.enter_context(socket.create_connection(("127.0.0.1", server.port)))
            asks.sendall(f"GET / HTTP/1.1\r\nHost: localhost:{server.port}\r\n\r\n".encode())
            clients.enter_context(never_reads(server))
        fill_buffers(server)
        reading = [clients.enter_context(connect(url(server), max_size=None)) for _ in range(25)]
        started = time.monotonic()
        server.publish("the end")
        server.stop()
        assert time.monotonic() - started < 10
        assert all(list(viewer)[-1] == "the end" for viewer in reading)
    while threading.active_count() >= threads:  # the threads of the clients
        time.sleep(0.01)


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
