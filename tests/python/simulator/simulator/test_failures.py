import pytest
from simulated import Recorder, build, protocol, timers

from gradysim.simulator.handler.timer import TimerException


def failing_timer(exception):
    def handle_timer(self, timer):
        raise exception

    tested = timers(12.5)
    tested.handle_timer = handle_timer
    return tested


def test_an_exception_of_a_protocol_passes_with_a_note():
    with pytest.raises(LookupError, match="broken") as raised:
        build(failing_timer(LookupError("broken"))).start_simulation()
    assert raised.value.__notes__ == ["in handle_timer of node 0 (Tested 0) at 12.5 s of simulated time"]


def test_what_a_handler_refuses_passes_with_a_note():
    def initialize(self):
        self.provider.schedule_timer("a", -1)

    with pytest.raises(TimerException) as raised:
        build(protocol(initialize=initialize)).start_simulation()
    assert raised.value.__notes__ == ["in initialize of node 0 (Tested 0) at 0 s of simulated time"]


def test_after_an_exception_nobody_finishes_but_handlers_are_finalized():
    calls = []
    tested = failing_timer(LookupError("broken"))
    tested.calls = calls
    simulator = build(tested, handlers=[Recorder(calls)])
    with pytest.raises(LookupError):
        simulator.step_simulation()
    simulator.finalize()
    assert calls[-1:] == [("finalize",)]
    assert ("finish", 0) not in calls
    assert (simulator.is_simulation_done(), simulator.step_simulation()) == (True, False)


def test_a_handler_that_fails_to_finalize_does_not_hide_the_exception(caplog):
    def fail():
        raise OSError("another")

    recorder = Recorder([])
    recorder.finalize = fail
    with pytest.raises(LookupError, match="broken"):
        build(failing_timer(LookupError("broken")), handlers=[recorder]).start_simulation()
    assert "recorder" in caplog.text


def test_an_exception_in_finish_passes_and_handlers_are_finalized():
    def finish(self):
        raise LookupError("broken")

    calls = []
    with pytest.raises(LookupError) as raised:
        build(protocol(finish=finish), handlers=[Recorder(calls)]).start_simulation()
    assert raised.value.__notes__ == ["in finish of node 0 (Tested 0) at 0 s of simulated time"]
    assert calls[-1] == ("finalize",)


def test_an_interrupted_simulation_finishes_once():
    tested = failing_timer(KeyboardInterrupt())
    simulator = build(tested)
    with pytest.raises(KeyboardInterrupt):
        simulator.start_simulation()
    simulator.finalize()
    assert tested.calls == [("finish", 0)]


def test_an_interrupted_step_leaves_the_end_to_the_caller():
    tested = failing_timer(KeyboardInterrupt())
    simulator = build(tested)
    with pytest.raises(KeyboardInterrupt):
        simulator.step_simulation()
    assert tested.calls == []
    simulator.finalize()
    assert tested.calls == [("finish", 0)]


def test_who_was_not_initialized_does_not_finish():
    def initialize(self):
        self.note("initialize")
        if self.provider.get_id() == 1:
            raise KeyboardInterrupt

    tested = protocol(initialize=initialize)
    with pytest.raises(KeyboardInterrupt):
        build(tested, nodes=3).start_simulation()
    assert tested.calls == [("initialize", 0), ("initialize", 1), ("finish", 0)]
