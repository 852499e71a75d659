"""The viewer in integrated mode."""

import json
import queue
import threading

import pytest

from gradysim.integrated.run import run
from gradysim.simulator.handler.visualization import VisualizationConfiguration, VisualizationHandler
from python.integrated.watching import FAILING, Watching

PAINTING = """
from gradysim.simulator.extension.visualization_controller import VisualizationController
class Tested(Talker):
    def initialize(self):
        super().initialize()
        VisualizationController(self).paint_node(self.provider.get_id(), (255, 0, 0))
"""


def visualization(**settings):
    return VisualizationHandler(
        VisualizationConfiguration(
            host="127.0.0.1", port=0, update_rate=0.001, information_collection_interval=0.1, **settings
        )
    )


class Audience(Watching):
    """Connects a viewer to a visualization at the start of a run, and reads to its end in a thread."""

    def __init__(self, shown):
        super().__init__("audience")
        self.shown = shown
        self.messages = []

    def initialize(self):
        from websockets.sync.client import connect

        greeted = queue.SimpleQueue()

        def read(connection):
            with connection:
                for message in connection:
                    self.messages.append(json.loads(message))
                    greeted.put(None)

        connection = connect(f"ws://127.0.0.1:{self.shown.port}")
        self.thread = threading.Thread(target=read, args=(connection,))
        self.thread.start()
        greeted.get(timeout=30)


@pytest.fixture
def watched(make_scenario):
    """Return the messages that a viewer of a run gets."""

    def watch(python):
        shown = visualization()
        audience = Audience(shown)
        run(make_scenario(python), handlers=[shown, audience])
        audience.thread.join(30)
        return audience.messages

    return watch


def test_a_viewer_learns_what_there_is(watched):
    assert watched("class Tested(Talker): pass")[0]["nodes"] == ["Tested 0", "Tested 1"]


def test_a_viewer_sees_the_end(watched):
    last = watched("class Tested(Talker): pass")[-1]
    assert last.pop("real_time") > 0
    assert last == {
        "nodes": [0, 1],
        "positions": [[0, 0, 0], [10, 0, 0]],
        "simulation_time": 2.05,
        "tracked_variables": [{"heard": 20, "finished": True}] * 2,
    }


def test_a_viewer_gets_the_controllers_commands(watched):
    commands = [message for message in watched(PAINTING) if "command" in message]
    assert commands == [
        {"command": "paint_node", "payload": {"node_id": node_id, "color": [255, 0, 0]}} for node_id in (0, 1)
    ]


def test_the_controller_knows_the_nodes(make_scenario):
    wrong = PAINTING.replace("self.provider.get_id(), (", "5, (")
    with pytest.raises(ValueError, match="node 5, "):
        run(make_scenario(wrong), handlers=[visualization()])


def test_a_shown_run_that_fails_leaves_no_thread(make_scenario):
    before = threading.active_count()
    with pytest.raises(LookupError):
        run(make_scenario(FAILING), handlers=[visualization()])
    assert threading.active_count() == before


def test_a_shown_run_is_the_same(make_scenario):
    shown, alone = run(make_scenario(), handlers=[visualization()]), run(make_scenario())
    assert shown.result_hash == alone.result_hash
