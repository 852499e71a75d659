import gc
import socket
import threading
import time
import urllib.request
import webbrowser
from contextlib import contextmanager

import pytest

from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.handler.visualization import (
    VisualizationConfiguration,
    VisualizationException,
    VisualizationHandler,
)
from gradysim.simulator.handler.visualization import handler as handler_module
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from gradysim.viewer.page import snapshot_page


def is_snapshot(message):
    return "positions" in message


def server_threads():
    return [thread for thread in threading.enumerate() if "visualization" in thread.name]


def test_its_label():
    assert VisualizationHandler.get_label() == "visualization"


def test_the_first_message_says_what_there_is(shown):
    show = shown(x_range=(-5, 5))
    show.start()
    assert show.viewer().read() == {
        "x_range": [-5, 5],
        "y_range": [-50, 50],
        "z_range": [0, 50],
        "nodes": ["Shown 0", "Shown 1"],
    }


def test_the_last_message_is_the_end_of_the_simulation(shown):
    show = shown()
    simulation = show.start(duration=3.5)
    viewer = show.viewer()
    viewer.read()
    simulation.start_simulation()
    last = viewer.read_to_the_end()[-1]
    assert last.pop("real_time") > 0
    assert last == {
        "nodes": [0, 1],
        "positions": [[1, 2, 3], [4, 5, 6]],
        "simulation_time": 3.5,
        "tracked_variables": [{"age": 3.0}, {"age": 3.0}],
    }


def test_the_connection_is_closed_in_order(shown):
    show = shown()
    simulation = show.start()
    viewer = show.viewer()
    viewer.read()
    simulation.start_simulation()
    viewer.read_to_the_end()
    assert viewer.connection.close_code == 1001


def test_all_viewers_get_the_same(shown):
    show = shown()
    simulation = show.start()
    viewers = [show.viewer() for _ in range(3)]
    for viewer in viewers:
        viewer.read()
    simulation.start_simulation()
    ends = [viewer.read_to_the_end()[-1] for viewer in viewers]
    assert ends[0] == ends[1] == ends[2]


def test_commands_wait_for_the_first_viewer(shown):
    show = shown()
    show.handler.command_queue.put({"command": "resize_nodes", "payload": {"size": 2}})
    show.start()
    message = show.viewer().read_until(lambda message: "command" in message)
    assert message == {"command": "resize_nodes", "payload": {"size": 2}}


def test_commands_without_any_viewer_stay_in_the_queue(shown):
    show = shown()
    command = {"command": "paint_node", "payload": {"node_id": 0, "color": (1, 2, 3)}}
    show.handler.command_queue.put(command)
    show.start().start_simulation()
    queue = show.handler.command_queue
    assert (queue.qsize(), queue.get(), queue.empty()) == (1, command, True)


@contextmanager
def running(simulation):
    """Run the simulation in a separate thread."""
    stop = threading.Event()

    def run():
        while not stop.is_set():
            simulation.run_events(100)

    thread = threading.Thread(target=run)
    thread.start()
    try:
        yield
    finally:
        stop.set()
        thread.join()


@pytest.fixture
def paused(shown):
    """Return a simulation in a thread, paused by a viewer; it continues at the end."""
    show = shown()
    simulation = show.start(duration=1e9)
    server = show.handler._server
    waiting = threading.Event()
    wait_while_paused = server.wait_while_paused

    def noted():
        waiting.set()
        wait_while_paused()

    server.wait_while_paused = noted
    viewer = show.viewer()
    with running(simulation):
        viewer.send('{"interaction": "pause/resume"}')
        assert waiting.wait(30)
        try:
            yield show, simulation, viewer
        finally:
            server._running.set()


def test_in_a_pause_viewers_see_where_it_stands(paused):
    _, simulation, viewer = paused
    at = simulation.current_time
    assert viewer.read_until(lambda message: message.get("simulation_time") == at)
    assert simulation.current_time == at


def test_newcomers_in_a_pause_see_it_too(paused):
    show, simulation, _ = paused
    newcomer = show.viewer()
    assert newcomer.read_until(lambda message: message.get("simulation_time") == simulation.current_time)


def test_a_viewer_resumes_the_simulation(paused):
    show, simulation, viewer = paused
    at = simulation.current_time
    viewer.send('{"interaction": "pause/resume"}')
    assert viewer.read_until(lambda message: message.get("simulation_time", 0) > at)
    assert show.handler.paused_s > 0


def test_a_simulation_in_real_time_does_not_catch_up_on_a_pause(shown, monkeypatch, wall_clock):
    monkeypatch.setattr(handler_module, "time", wall_clock)
    show = shown()
    start = wall_clock.monotonic()
    simulation = show.start(real_time=True, duration=2)
    server = show.handler._server

    def resume():
        wall_clock.sleep(3)
        server._running.set()

    monkeypatch.setattr(server, "wait_while_paused", resume)
    server._running.clear()
    simulation.start_simulation()
    assert wall_clock.monotonic() - start == pytest.approx(3 + 2)


def test_pauses_add_up(shown, monkeypatch, wall_clock):
    monkeypatch.setattr(handler_module, "time", wall_clock)
    show = shown()
    simulation = show.start()
    server = show.handler._server

    def resume():
        wall_clock.sleep(3)
        server._running.set()

    monkeypatch.setattr(server, "wait_while_paused", resume)
    for paused_s in (3, 6):
        server._running.clear()
        simulation.run_events(5)
        assert show.handler.paused_s == paused_s


def test_a_pause_ends_when_the_viewer_that_paused_leaves(paused):
    show, simulation, viewer = paused
    other = show.viewer()
    at = simulation.current_time
    viewer.connection.close()
    assert other.read_until(lambda message: message.get("simulation_time", 0) > at)


def test_a_pause_ends_when_the_connection_is_lost(paused):
    show, simulation, viewer = paused
    other = show.viewer()
    at = simulation.current_time
    viewer.connection.socket.shutdown(socket.SHUT_RDWR)
    assert other.read_until(lambda message: message.get("simulation_time", 0) > at)


def test_a_pause_goes_on_when_another_viewer_leaves(paused):
    show, _, viewer = paused
    server = show.handler._server
    other = show.viewer()
    other.read()
    other.connection.close()
    viewer.connection.ping().wait(30)
    while len(server._viewers) > 1:
        time.sleep(0.01)
    assert server.is_paused


def test_nonsense_of_a_viewer_is_ignored_with_one_warning(shown, caplog):
    show = shown()
    simulation = show.start()
    viewer = show.viewer()
    for _ in range(3):
        viewer.send("{nonsense")
    viewer.connection.ping().wait(30)
    simulation.start_simulation()
    assert ["{nonsense" in message for message in caplog.messages] == [True]


def test_the_log_says_once_where_the_page_is(shown, caplog):
    caplog.set_level("INFO")
    show = shown()
    simulation = show.start()
    address = f"http://127.0.0.1:{show.handler.port}/"
    with urllib.request.urlopen(address, timeout=30) as answer:
        assert answer.headers["Content-Type"] == "text/html; charset=utf-8"
        assert answer.read().decode() == snapshot_page()
    simulation.start_simulation()
    assert [message for message in caplog.messages if "http:" in message] == [
        f"The simulation is shown at {address}"
    ]


def test_values_that_json_does_not_know_are_shown_as_text(shown):
    class Odd(shown().protocol):
        def initialize(self):
            self.provider.tracked_variables.update(set={1}, nan=float("nan"), number=1)
            super().initialize()

    show = shown(Odd)
    simulation = show.start(duration=1)
    viewer = show.viewer()
    viewer.read()
    simulation.start_simulation()
    assert viewer.read_to_the_end()[-1]["tracked_variables"][0] == {
        "set": "{1}",
        "nan": "nan",
        "number": 1,
        "age": 1.0,
    }


def test_no_thread_is_left(shown):
    shown().start().start_simulation()
    assert server_threads() == []


def test_a_dropped_simulation_leaves_no_thread():
    handler = VisualizationHandler(VisualizationConfiguration(host="127.0.0.1", port=0))
    builder = SimulationBuilder(SimulationConfiguration(execution_logging=False)).add_handler(handler)
    builder.build().step_simulation()
    del handler, builder
    gc.collect()
    assert server_threads() == []


def test_it_does_not_keep_a_simulation_going_by_itself():
    builder = SimulationBuilder(SimulationConfiguration(execution_logging=False)).add_handler(TimerHandler())
    builder.add_handler(VisualizationHandler(VisualizationConfiguration(host="127.0.0.1", port=0)))
    simulation = builder.build()
    simulation.start_simulation()
    assert simulation.iteration == 1


def test_a_simulation_whose_address_is_in_use_goes_on_without_viewers(shown, caplog, monkeypatch):
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    first = shown()
    first.start()
    second = shown(port=first.handler.port, open_browser=True)
    simulator = second.start()
    simulator.start_simulation()
    assert simulator.current_time == 100
    assert second.handler.port is None
    assert opened == []
    (warning,) = [record.getMessage() for record in caplog.records if record.levelname == "WARNING"]
    assert f"127.0.0.1 port {first.handler.port}: " in warning
    assert "`port`" in warning


def test_a_host_of_another_machine_is_refused(shown):
    with pytest.raises(VisualizationException, match=r"192\.0\.2\.1"):
        shown(host="192.0.2.1").start()


@pytest.mark.parametrize("wanted", [True, False])
def test_the_page_is_opened_if_asked_for(shown, monkeypatch, wanted):
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    show = shown(open_browser=wanted)
    show.start()
    assert opened == ([f"http://127.0.0.1:{show.handler.port}/"] if wanted else [])


def test_the_port_is_known_while_it_runs(shown):
    show = shown()
    before = show.handler.port
    simulation = show.start()
    during = show.handler.port
    simulation.start_simulation()
    assert (before, during > 0, show.handler.port) == (None, True, None)


def test_it_serves_one_simulation_after_the_other(shown):
    show = shown()
    for _ in range(2):
        simulation = show.start()
        viewer = show.viewer()
        assert viewer.read()["nodes"] == ["Shown 0", "Shown 1"]
        simulation.start_simulation()


def test_handlers_in_general_hold_nothing_up():
    assert INodeHandler.paused_s == 0
