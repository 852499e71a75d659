"""`gradysim run --trace` and `--log-level`."""

import pytest

from python.cli.command import both_modes, objects, run_gradysim

LOGGING = """
from protocol import *
import logging

class Logging(Talker):
    def handle_timer(self, timer):
        super().handle_timer(timer)
        logging.info("said")
        logging.debug("in detail")
"""


def events(output):
    """Return the events of the lines of a trace, or of a log."""
    rows = [line.split(maxsplit=3) for line in output.splitlines()]
    return [row[2] for row in rows if len(row) > 2 and row[1].startswith("uavs[")]


@both_modes
def test_a_trace_is_on_standard_output(gradysim, mode):
    done = gradysim("run", "test.ini", "--mode", mode, "-r", "0", "--trace", "uavs[0]", "--quiet")
    assert (done.returncode, done.stderr) == (0, "")
    assert {"timer", "tx", "rx", "set"} == set(events(done.stdout))
    assert "uavs[1]  " not in done.stdout


@both_modes
def test_beside_json_a_trace_is_on_the_error_output(gradysim, mode):
    done = gradysim("run", "test.ini", "--mode", mode, "-r", "0", "--trace", "all", "--json")
    assert len(objects(done.stdout)) == 1
    assert "tx" in events(done.stderr)


@both_modes
def test_a_run_can_have_a_trace_and_a_replay(gradysim, folder, mode):
    names = ("--trace", "uavs[0]", "--replay", "uavs[1]")
    done = gradysim("run", "test.ini", "--mode", mode, "-r", "0", *names, "--quiet")
    assert set(events(done.stdout)) == {"timer", "tx", "rx", "set"}
    assert (folder / "results" / f"General-#0.{mode}.html").stat().st_size > 1000


def test_a_name_that_no_node_has_is_a_mistake(gradysim):
    done = gradysim("run", "test.ini", "--mode", "prototype", "--trace", "uavs[7]")
    assert done.returncode == 2
    assert done.stderr.startswith("--trace uavs[7]: ")


@both_modes
@pytest.mark.parametrize(
    ("options", "levels"),
    [((), {"info"}), (("--log-level", "warning"), set()), (("--quiet",), set())],
)
def test_log_lines_are_on_the_error_output(folder, mode, options, levels):
    (folder / "logging_protocol.py").write_text(LOGGING, encoding="utf-8")
    chosen = '*.uavs[*].protocol.class="logging_protocol.py:Logging"'
    done = run_gradysim(folder, "run", "test.ini", "--mode", mode, "-r", "0", "--set", chosen, *options)
    assert done.returncode == 0
    assert set(events(done.stderr)) == levels
