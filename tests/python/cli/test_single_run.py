from asyncio import CancelledError
from io import StringIO
from types import SimpleNamespace

import pytest
from rich.console import Console

from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.single_run import execute
from gradysim.integrated.compiled_part import CompiledPartMissingError
from gradysim.results.result import RunResult
from gradysim.scenario.errors import ConfigError

SCENARIO = SimpleNamespace(config="General", run_number=0, sim_time_limit_s=10.0, nodes=())


class FakeRun:
    """A run with a given end."""

    lacks_output = False

    def __init__(self, ending=None, interrupted=False):
        self.ending, self.interrupted = ending, interrupted
        self.arguments = None

    def execute(self, progress=None, should_stop=None):
        self.arguments = (progress, should_stop)
        if progress is not None:
            progress(5.0)
        if self.ending is not None:
            raise self.ending

    def result(self):
        return RunResult("General", 0, 0, "prototype", 5.0, 1.0, 1.0, 3, self.interrupted, None, {}, ())

    def findings(self):
        return []


def test_a_whole_run():
    outcome = execute(lambda _: FakeRun(), SCENARIO, StopOnInterrupt(), None)
    assert (outcome.result.events, outcome.failure, outcome.interrupted) == (3, None, False)


def test_a_stopped_run():
    assert execute(lambda _: FakeRun(interrupted=True), SCENARIO, StopOnInterrupt(), None).interrupted


@pytest.mark.parametrize("failure", [RuntimeError("spoilt"), SystemExit(3), CancelledError()])
def test_a_failing_run_keeps_its_result(failure):
    outcome = execute(lambda _: FakeRun(failure, interrupted=True), SCENARIO, StopOnInterrupt(), None)
    assert outcome.failure is failure
    assert outcome.result.events == 3
    assert not outcome.interrupted


def test_an_interrupt_that_comes_through_keeps_the_result():
    outcome = execute(lambda _: FakeRun(KeyboardInterrupt()), SCENARIO, StopOnInterrupt(), None)
    assert outcome.interrupted
    assert outcome.result.events == 3


@pytest.mark.parametrize("failure", [ZeroDivisionError(), SystemExit(3), CancelledError()])
def test_a_protocol_that_cannot_be_made_is_a_failure_without_a_result(failure):
    def build(_):
        raise failure

    outcome = execute(build, SCENARIO, StopOnInterrupt(), None)
    assert outcome.result is None
    assert outcome.failure is failure


@pytest.mark.parametrize(
    "mistake", [ConfigError("wrong"), CompiledPartMissingError("missing"), KeyboardInterrupt()]
)
def test_a_mistake_and_an_interruption_are_passed_on(mistake):
    def build(_):
        raise mistake

    with pytest.raises(type(mistake)):
        execute(build, SCENARIO, StopOnInterrupt(), None)


def test_without_a_console_nothing_is_shown():
    run = FakeRun()
    interrupt = StopOnInterrupt()
    execute(lambda _: run, SCENARIO, interrupt, None)
    assert run.arguments == (None, interrupt.should_stop)


def test_with_a_console_a_bar_that_names_the_run_is_moved():
    run, shown = FakeRun(), StringIO()
    terminal = Console(file=shown, force_terminal=True, width=100)
    execute(lambda _: run, SCENARIO, StopOnInterrupt(), terminal)
    assert "run 0" in shown.getvalue()
    assert "5 of 10 s" in shown.getvalue()
