"""The server of a live view, with real connections."""

import json
import socket
import threading
import time
import urllib.error
import urllib.request
from contextlib import ExitStack
from urllib.parse import urlsplit

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from gradysim.prototype.run import PrototypeRun
from gradysim.replay.chunk import unpack
from gradysim.replay.live import LiveView
from gradysim.viewer.server import LONGEST_MESSAGE_BYTES
from python.processes import wait_until


@pytest.fixture
def live():
    with LiveView() as view:
        yield view


@pytest.fixture
def published():
    with LiveView(host="0.0.0.0") as view:
        yield view


def status_for(live, path, *headers):
    """Return the status line of the response to a request."""
    with socket.create_connection(("127.0.0.1", urlsplit(live.address).port)) as connection:
        connection.sendall("\r\n".join([f"GET {path} HTTP/1.1", *headers, "", ""]).encode())
        return connection.recv(1000).partition(b"\r\n")[0].decode()


def join(live, **options):
    address = urlsplit(live.address)
    options = {"max_size": None, "ping_interval": None, "compression": None, "close_timeout": 0.1, **options}
    return connect(f"ws://{address.netloc}/chunks?{address.query}", **options)


def run_in_thread(scenario, live, should_stop=lambda: False):
    run = PrototypeRun(scenario, replay=live)
    thread = threading.Thread(target=run.execute, args=(None, live.paced(should_stop)), daemon=True)
    thread.start()
    return thread


def told_by(viewer):
    """Return the messages that a viewer gets up to the end of the run."""
    run, chunks = None, []
    for message in viewer:
        if isinstance(message, bytes):
            chunks.append(unpack(message))
            continue
        content = json.loads(message)
        run = content.get("run", run)
        if "end" in content:
            return run, chunks, content["end"]
    raise AssertionError("the connection ended before the run")


def ends(thread):
    thread.join(30)
    return not thread.is_alive()


def test_viewers_get_the_whole_run_also_late_ones(live, make_scenario):
    scenario = make_scenario()
    with join(live) as early:
        assert ends(run_in_thread(scenario, live))
        with join(live) as late:
            for run, chunks, end in (told_by(early), told_by(late)):
                assert run["config"] == "General"
                assert chunks[0].start_ns == 0
                assert end["complete"]
                assert chunks[-1].end_ns == pytest.approx(end["time_s"] * 1e9)


def test_the_run_waits_for_a_viewer_that_does_not_go_on(live, make_scenario):
    scenario = make_scenario("class Tested(Talker): pass", "sim-time-limit = 600s")
    with join(live) as viewer:
        viewer.send('{"time_s": 0, "speed": 0}')
        wait_until(lambda: live.clocks)
        thread = run_in_thread(scenario, live)
        for message in viewer:
            if isinstance(message, bytes):
                break
        time.sleep(0.5)
        seen_s = live.recorded_s
        time.sleep(0.5)
        assert thread.is_alive()
        assert live.recorded_s == seen_s
        viewer.send('{"time_s": 700, "speed": 1}')
        assert ends(thread)


def test_a_run_that_waits_is_stopped_and_shown_up_to_its_end(live, make_scenario):
    stop = threading.Event()
    with join(live) as viewer:
        viewer.send('{"time_s": 0, "speed": 0}')
        wait_until(lambda: live.clocks)
        scenario = make_scenario("class Tested(Talker): pass", "sim-time-limit = 600s")
        thread = run_in_thread(scenario, live, stop.is_set)
        wait_until(lambda: live.recorded_s > max(live.clocks.values()))
        stop.set()
        _, chunks, end = told_by(viewer)
        assert ends(thread)
    assert not end["complete"]
    assert [chunk.start_ns for chunk in chunks] == [0, *(chunk.end_ns for chunk in chunks[:-1])]
    assert chunks[-1].end_ns == pytest.approx(end["time_s"] * 1e9)


@pytest.mark.parametrize(
    "garbage", ["", "{", "[1]", '{"time_s": "x", "speed": 1}', b"\0", " " * (LONGEST_MESSAGE_BYTES + 1)]
)
def test_garbage_ends_a_connection_and_not_the_run(live, make_scenario, garbage):
    with join(live) as viewer:
        viewer.send(garbage)
        with pytest.raises(ConnectionClosed):
            viewer.recv(timeout=10)
    assert ends(run_in_thread(make_scenario(), live))


def test_a_viewer_that_pauses_and_leaves_stops_nobody(live, make_scenario):
    with join(live) as viewer:
        viewer.send('{"time_s": 0, "speed": 0}')
        wait_until(lambda: live.clocks)
        thread = run_in_thread(make_scenario("class Tested(Talker): pass", "sim-time-limit = 300s"), live)
        time.sleep(0.5)
        assert thread.is_alive()
    assert ends(thread)


@pytest.mark.verify
def test_a_hundred_viewers_some_of_which_never_read(live, make_scenario):
    with ExitStack() as all_viewers:
        for _ in range(50):
            all_viewers.enter_context(join(live, max_queue=1))  # never reads
        viewers = [all_viewers.enter_context(join(live)) for _ in range(50)]
        assert ends(run_in_thread(make_scenario("class Tested(Talker): pass", "sim-time-limit = 200s"), live))
        assert all(told_by(viewer)[2]["complete"] for viewer in viewers)


@pytest.mark.parametrize("path", ["/", "/chunks", "/?token=x", "/chunks?token=x"])
def test_nobody_gets_in_without_the_token(live, path):
    address = urlsplit(live.address)
    with pytest.raises(urllib.error.HTTPError) as refused:
        urllib.request.urlopen(f"http://{address.netloc}{path}")
    assert refused.value.code == 403
    refused.value.close()


def test_no_page_of_another_origin_gets_in(live):
    with pytest.raises(InvalidStatus) as refused, join(live, origin="http://example.org"):
        pass
    assert refused.value.response.status_code == 403


def test_no_other_name_of_this_machine_gets_in(live):
    path = f"/?{urlsplit(live.address).query}"
    assert " 403 " in status_for(live, path, "Host: evil.example")


def test_a_published_page_is_named_localhost(published):
    assert urlsplit(published.address).hostname == "localhost"


def test_a_published_page_has_any_name(published):
    path = f"/?{urlsplit(published.address).query}"
    assert " 200 " in status_for(published, path, "Host: simulations.example:8000")


@pytest.mark.parametrize("path", ["/", "/?token=x"])
def test_a_published_page_needs_the_token(published, path):
    assert " 403 " in status_for(published, path, "Host: simulations.example:8000")


def test_a_published_page_refuses_other_origins(published):
    path = f"/?{urlsplit(published.address).query}"
    headers = ("Host: simulations.example:8000", "Origin: http://evil.example")
    assert " 403 " in status_for(published, path, *headers)


def test_the_page_connects_to_its_server(live):
    with urllib.request.urlopen(live.address) as answer:
        text = answer.read().decode()
    token = urlsplit(live.address).query
    assert f'id="gradysim-live">{{"socket":"/chunks?{token}"}}' in text
