import logging
from types import SimpleNamespace

import pytest

from gradysim.simulator.log import SimulationFormatter, format_table, label_node, setup_simulation_formatter


def line(formatter, level=logging.INFO, message="hello"):
    return formatter.format(logging.LogRecord("name", level, "path", 1, message, None, None))


@pytest.fixture
def root():
    root = logging.getLogger()
    before = (list(root.handlers), root.level)
    yield root
    assert (root.handlers, root.level) == before


def test_outside_of_events_a_line_is_level_and_message():
    assert line(SimulationFormatter()) == "INFO     hello"


def test_an_event_puts_iteration_time_and_context_in_front():
    formatter = SimulationFormatter(clock=lambda: 7.5)
    formatter.scope_event(3, "P 0 handle_timer")
    expected = "WARNING  [it=3 time=0:00:07.500000 | P 0 handle_timer] hello"
    assert line(formatter, logging.WARNING) == expected


def test_clearing_takes_the_event_away():
    formatter = SimulationFormatter()
    formatter.scope_event(3, "context")
    formatter.clear_iteration()
    assert (formatter.prefix, line(formatter)) == ("", "INFO     hello")


def test_setting_up_and_removing_leave_nothing_behind(root):
    before = len(root.handlers)
    formatter = setup_simulation_formatter(False, None)
    assert len(root.handlers) == before + 1
    formatter.remove()


def test_removing_twice_does_nothing(root):
    formatter = setup_simulation_formatter(False, None)
    formatter.remove()
    formatter.remove()


@pytest.mark.parametrize(
    ("options", "levels"),
    [
        ({"debug": False}, ["INFO", "WARNING"]),
        ({"debug": True}, ["DEBUG", "INFO", "WARNING"]),
        ({"debug": True, "quiet": True}, ["WARNING"]),
    ],
)
def test_levels(root, capsys, options, levels):
    formatter = setup_simulation_formatter(log_file=None, **options)
    for level in (logging.DEBUG, logging.INFO, logging.WARNING):
        logging.getLogger("protocol").log(level, "hello")
    formatter.remove()
    assert [text.split()[0] for text in capsys.readouterr().err.splitlines()] == levels


def test_the_lines_go_to_the_file_too(root, tmp_path):
    formatter = setup_simulation_formatter(False, tmp_path / "run.log")
    logging.getLogger().info("hällo")
    formatter.remove()
    assert (tmp_path / "run.log").read_text(encoding="utf-8") == "INFO     hällo\n"


def test_a_node_is_called_by_its_protocol_and_id():
    encapsulator = SimpleNamespace(protocol=SimpleNamespace())
    assert label_node(SimpleNamespace(id=2, protocol_encapsulator=encapsulator)) == "SimpleNamespace 2"


@pytest.mark.parametrize(
    "node", [SimpleNamespace(id=2), SimpleNamespace(id=2, protocol_encapsulator=SimpleNamespace())]
)
def test_a_node_without_a_protocol_is_called_by_its_id(node):
    assert label_node(node) == "Node 2"


def test_a_table_is_as_wide_as_its_cells():
    assert format_table(["a", "bb"], [["long", "1"], ["x", "2"]]).splitlines() == [
        "a     bb",
        "----  --",
        "long  1",
        "x     2",
    ]
