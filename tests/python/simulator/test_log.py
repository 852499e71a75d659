import logging
import threading
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


def test_a_root_logger_that_lets_more_pass_goes_on_doing_so(root):
    before = root.level
    root.setLevel(logging.DEBUG)
    formatter = setup_simulation_formatter(False, None)
    during = root.level
    formatter.remove()
    after = root.level
    root.setLevel(before)
    assert (during, after) == (logging.DEBUG, logging.DEBUG)


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


# Several simulations


@pytest.fixture
def two(root, tmp_path):
    """Return two formatters that log to a file each, and a function that reads a file."""
    formatters = [setup_simulation_formatter(False, tmp_path / name) for name in ("first", "second")]
    yield *formatters, lambda name: (tmp_path / name).read_text()
    for formatter in formatters:
        formatter.remove()


def test_a_line_of_the_one_that_is_running_is_its_own(root, two):
    first, _, text = two
    first.thread = threading.get_ident()
    root.info("hello")
    assert (text("first"), text("second")) == ("INFO     hello\n", "")


def test_a_line_of_none_is_written_once(root, two):
    _, _, text = two
    root.info("hello")
    assert (text("first"), text("second")) == ("", "INFO     hello\n")


def test_what_runs_in_another_thread_does_not_count(root, two):
    first, _, text = two
    first.thread = threading.get_ident() + 1
    root.info("hello")
    assert text("first") == ""


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_the_level_is_as_before_in_whatever_order_they_end(root, order):
    before = root.level
    formatters = [setup_simulation_formatter(debug, None) for debug in (False, True)]
    assert root.level == logging.DEBUG
    for index in order:
        formatters[index].remove()
    assert root.level == before


def test_a_level_that_somebody_else_set_meanwhile_stays(root):
    before = root.level
    formatter = setup_simulation_formatter(True, None)
    root.setLevel(logging.CRITICAL)
    formatter.remove()
    after = root.level
    root.setLevel(before)
    assert after == logging.CRITICAL


def test_a_log_file_that_cannot_be_written_leaves_nothing_behind(root, tmp_path):
    with pytest.raises(OSError, match="missing"):
        setup_simulation_formatter(False, tmp_path / "missing" / "log")
