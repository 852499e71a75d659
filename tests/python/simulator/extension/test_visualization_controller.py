import math

import pytest

from gradysim.simulator.extension.visualization_controller import VisualizationController
from gradysim.simulator.handler.visualization import VisualizationHandler


@pytest.fixture
def handler():
    return VisualizationHandler()


@pytest.fixture
def controller(protocols, handler):
    return VisualizationController(protocols([(0, 0, 0), (1, 1, 1)], handler)[0])


@pytest.mark.parametrize(
    ("method", "arguments", "command"),
    [
        ("paint_node", (1, (255, 0, 10)), {"node_id": 1, "color": (255, 0, 10)}),
        ("paint_node", (0, [1.5, 0, 0]), {"node_id": 0, "color": (1.5, 0, 0)}),
        ("paint_environment", ((0.1, 0.2, 1),), {"color": (0.1, 0.2, 1)}),
        ("resize_nodes", (2,), {"size": 2}),
        ("show_node_id", (1, False), {"node_id": 1, "show": False}),
    ],
)
def test_commands(controller, handler, method, arguments, command):
    getattr(controller, method)(*arguments)
    assert handler.command_queue.get() == {"command": method, "payload": command}


@pytest.mark.parametrize(
    ("method", "arguments", "error", "expected"),
    [
        ("paint_node", (2, (0, 0, 0)), ValueError, "node 2, "),
        ("paint_node", ("0", (0, 0, 0)), TypeError, "'0'"),
        ("paint_node", (0, (0, 0)), ValueError, " 0 to 255"),
        ("paint_node", (0, (256, 0, 0)), ValueError, "256"),
        ("paint_node", (0, "red"), ValueError, "'red'"),
        ("paint_environment", ((-1, 0, 0),), ValueError, "-1"),
        ("paint_environment", ((math.nan, 0, 0),), ValueError, "nan"),
        ("paint_environment", ((10**400, 0, 0),), ValueError, " >= 0"),
        ("resize_nodes", (0,), ValueError, "> 0, got 0"),
        ("resize_nodes", ("big",), ValueError, "'big'"),
        ("resize_nodes", (math.inf,), ValueError, "> 0, got inf"),
        ("show_node_id", (0, 1), TypeError, "got 1"),
    ],
)
def test_wrong_arguments(controller, method, arguments, error, expected):
    with pytest.raises(error, match=expected):
        getattr(controller, method)(*arguments)


def test_without_a_handler_commands_do_nothing(protocols):
    VisualizationController(*protocols([(0, 0, 0)])).paint_node(0, (1, 2, 3))


def test_in_other_modes_commands_do_nothing(hosted):
    VisualizationController(hosted).resize_nodes(2)


def test_without_a_provider_it_cannot_be(idle):
    with pytest.raises(ReferenceError):
        VisualizationController(idle())
