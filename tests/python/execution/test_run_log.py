"""Log lines of protocols, in both modes."""

import logging
from contextlib import contextmanager

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.prototype.run import PrototypeRun
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter
from gradysim.replay.tables import EVENT_KINDS

RUNS = {"integrated": IntegratedRun, "prototype": PrototypeRun}

LOGGING = """
import logging

class Tested(Talker):
    def initialize(self):
        super().initialize()
        logging.getLogger("mine").info("begun")
        logging.getLogger("mine").debug("in detail")
        logging.getLogger("gradysim.plugin").info("of a plugin")
    def handle_packet(self, message):
        super().handle_packet(message)
        if self.heard == 1:
            logging.getLogger("mine").warning("first\\nmessage")
    def finish(self):
        logging.getLogger("mine").error("ended")
"""


@pytest.fixture(params=sorted(RUNS))
def mode(request):
    return request.param


@contextmanager
def logging_with(*handlers):
    """Give the root logger only these handlers inside the block.

    Pytest adds some before each phase of a test.
    """
    root = logging.getLogger()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(root, "handlers", list(handlers))
        root.setLevel(logging.WARNING)
        yield
        assert (root.handlers, root.level) == (list(handlers), logging.WARNING)


@pytest.fixture
def logged(mode, make_scenario, capsys):
    def run(level, replay=None, handlers=()):
        with logging_with(*handlers):
            RUNS[mode](make_scenario(LOGGING), log_level=level, replay=replay).execute()
        lines = [line.split(maxsplit=3) for line in capsys.readouterr().err.splitlines()]
        return [(float(time_s), *rest) for time_s, *rest in lines]

    return run


def test_lines_have_time_and_node(logged):
    lines = logged(logging.INFO)
    assert lines[:2] == [(0.0, "uavs[0]", "info", "begun"), (0.0, "uavs[1]", "info", "begun")]
    assert lines[-2:] == [(2.05, "uavs[0]", "error", "ended"), (2.05, "uavs[1]", "error", "ended")]
    received = [line for line in lines if line[2] == "warning"]
    assert [line[3] for line in received] == ["first", "message"] * 2
    assert {line[1] for line in received} == {"uavs[0]", "uavs[1]"}


@pytest.mark.parametrize(
    ("level", "expected"),
    [
        (logging.ERROR, ["ended"]),
        (logging.INFO, ["begun", "first", "message", "ended"]),
        (logging.DEBUG, ["begun", "in detail", "of a plugin", "first", "message", "ended"]),
    ],
)
def test_the_level_chooses_lines(logged, level, expected):
    mine = [text for _, node, _, text in logged(level) if node == "uavs[0]"]
    assert [text for text in mine if " sends " not in text] == expected


def test_a_handler_of_the_user_writes_the_lines_instead(logged):
    written = []

    class Own(logging.Handler):
        def emit(self, record):
            written.append(record.getMessage())

    assert logged(logging.INFO, handlers=[Own()]) == []
    assert written == ["first\nmessage"] * 2 + ["ended"] * 2  # at the user's level


def test_a_file_of_the_user_gets_them_too(logged, tmp_path):
    handler = logging.FileHandler(tmp_path / "log")
    assert logged(logging.WARNING, handlers=[handler])[-1][3] == "ended"
    handler.close()
    assert (tmp_path / "log").read_text().count("ended") == 2


def test_a_replay_has_the_lines(logged, tmp_path):
    logged(logging.INFO, ReplayWriter(tmp_path / "run.html"))
    events = read_replay(tmp_path / "run.html").table("events")
    found = [
        (node, EVENT_KINDS[kind], text)
        for node, kind, text in zip(events["node"], events["kind"], events["text"], strict=True)
        if EVENT_KINDS[kind] not in ("timer", "command")
    ]
    assert found[:2] == [(0, "info", "begun"), (0, "info", "of a plugin")]
    assert found[-1] == (1, "error", "ended")


def test_a_line_outside_of_callbacks_has_no_node(mode, make_scenario, capsys):
    run = RUNS[mode](make_scenario(), log_level=logging.INFO)
    with logging_with():
        run.execute(progress=lambda _: logging.getLogger("mine").info("between"))
    lines = [line.split(maxsplit=3) for line in capsys.readouterr().err.splitlines()]
    assert {(node, text) for _, node, _, text in lines} == {("-", "between")}


def test_a_run_inside_another_one_has_its_own_lines(make_scenario, capsys):
    scenario = make_scenario(LOGGING)
    outer = PrototypeRun(scenario, log_level=logging.INFO)
    inner = IntegratedRun(scenario, log_level=logging.INFO)
    done = []

    def once(_):
        if not done:
            done.append(True)
            inner.execute()

    with logging_with():
        outer.execute(progress=once)
    assert sum("ended" in line for line in capsys.readouterr().err.splitlines()) == 4
