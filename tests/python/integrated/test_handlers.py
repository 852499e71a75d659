"""Handlers in integrated mode: their arguments, the order of their calls, and the end of a run."""

import math

import pytest

from gradysim.integrated.run import IntegratedRun, run
from gradysim.simulator.event import EventLoopException
from gradysim.simulator.handler.communication import CommunicationHandler
from gradysim.simulator.handler.interface import IAsyncNodeHandler
from gradysim.simulator.handler.mobility import MobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from python.integrated.watching import FAILING, Scheduling, Stepping, Watching

DIARY = """
class Tested(Quiet):
    diary = []
    def initialize(self): self.diary.append(f"initialize {self.provider.get_id()}")
    def finish(self): self.diary.append(f"finish {self.provider.get_id()}")
"""


def test_a_step_after_every_event_at_its_time(make_scenario):
    handler = Stepping()
    result = run(make_scenario(), handlers=[handler])
    assert [iteration for iteration, _ in handler.steps] == list(range(result.events))
    times = [time for _, time in handler.steps]
    assert times == sorted(times)
    assert {0.1, 0.11, 0.5} <= set(times)


def test_the_last_step_is_at_the_time_of_its_event(make_scenario):
    handler = Stepping()
    scenario = make_scenario(
        'class Tested(Quiet):\n    def initialize(self): self.provider.schedule_timer("only", 0.5)',
        "*.uavs[*].mobility.telemetryInterval = 0s",
    )
    result = run(scenario, handlers=[handler])
    assert handler.steps == [(0, 0.5), (1, 0.5)]
    assert result.sim_time_s == 2.05


@pytest.mark.parametrize("handler", [Watching, Stepping])
def test_who_watches_changes_nothing(make_scenario, handler):
    alone, watched = run(make_scenario()), run(make_scenario(), handlers=[handler()])
    assert (watched.result_hash, watched.events) == (alone.result_hash, alone.events)
    assert [node.tracked_variables for node in watched.nodes] == [
        node.tracked_variables for node in alone.nodes
    ]


def test_only_who_wants_steps_makes_the_run_go_step_by_step(make_scenario):
    runs = [IntegratedRun(make_scenario(), handlers=[handler]) for handler in (Watching(), Stepping())]
    assert [bool(run._handlers._hooks) for run in runs] == [False, True]


def test_handlers_begin_before_the_protocols_and_end_after_them(make_scenario):
    class Writing(Watching):
        def initialize(self):
            self.nodes[0].protocol_encapsulator.protocol.diary.append("handler begins")

        def finalize(self):
            self.diary = self.nodes[0].protocol_encapsulator.protocol.diary
            self.diary.append("handler ends")

    handler = Writing()
    run(make_scenario(DIARY), handlers=[handler])
    assert handler.diary == [
        "handler begins",
        "initialize 0",
        "initialize 1",
        "finish 0",
        "finish 1",
        "handler ends",
    ]


def test_handlers_end_after_a_protocol_failed(make_scenario):
    handlers = [Watching("one"), Watching("two")]
    with pytest.raises(LookupError):
        run(make_scenario(FAILING), handlers=handlers)
    assert [handler.ended for handler in handlers] == [1, 1]


def test_a_failure_at_the_end_does_not_hide_the_one_before(make_scenario, caplog):
    class Bad(Watching):
        def finalize(self):
            raise ValueError("and another one")

    with pytest.raises(LookupError):
        run(make_scenario(FAILING), handlers=[Bad()])
    assert "watching " in caplog.text


def test_a_failure_at_the_end_of_a_good_run_is_raised_and_the_others_end(make_scenario):
    class Bad(Watching):
        def finalize(self):
            raise ValueError("spoilt")

    other = Watching("other")
    with pytest.raises(ValueError, match="spoilt"):
        run(make_scenario(), handlers=[Bad(), other])
    assert other.ended == 1


def test_a_handler_that_did_not_begin_does_not_end(make_scenario):
    class Bad(Watching):
        def initialize(self):
            raise ValueError("spoilt")

    first, second = Bad("first"), Watching("second")
    with pytest.raises(ValueError, match="spoilt"):
        run(make_scenario(), handlers=[first, second])
    assert (first.ended, second.ended) == (1, 0)


def test_handlers_end_when_the_run_is_stopped(make_scenario):
    handler = Stepping()
    result = run(make_scenario(), handlers=[handler], should_stop=lambda: True)
    assert result.interrupted
    assert handler.ended == 1


def test_handlers_end_when_the_run_is_interrupted(make_scenario):
    def interrupt():
        raise KeyboardInterrupt

    handler = Scheduling(0.5, interrupt)
    with pytest.raises(KeyboardInterrupt):
        run(make_scenario(), handlers=[handler])
    assert handler.ended == 1


def test_an_interrupt_while_handlers_begin_is_passed_on(make_scenario):
    class Beginning(Watching):
        def initialize(self):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(make_scenario(), handlers=[Beginning()])


@pytest.mark.parametrize(
    "handler", [CommunicationHandler, TimerHandler, MobilityHandler], ids=lambda handler: handler.get_label()
)
def test_the_engine_is_the_world(make_scenario, handler):
    label = handler.get_label()
    with pytest.raises(ValueError, match=rf"integrated.* {label}"):
        run(make_scenario(), handlers=[handler()])


def test_a_handler_that_waits_for_the_world_outside_is_refused(make_scenario):
    class Waiting(Watching, IAsyncNodeHandler):
        pass

    with pytest.raises(ValueError, match=r"Waiting .*asyncio.*integrated"):
        run(make_scenario(), handlers=[Waiting()])


def test_a_handler_can_serve_one_run_after_the_other(make_scenario):
    handler = Stepping()
    first = run(make_scenario(), handlers=[handler])
    run(make_scenario(), handlers=[handler])
    assert len(handler.steps) == 2 * first.events


def test_events_run_at_their_times(make_scenario):
    times = []
    handler = Scheduling(0.25, lambda: times.append(handler.event_loop.current_time))
    run(make_scenario(), handlers=[handler])
    assert times == [0.25]


def test_an_event_can_schedule_the_next(make_scenario):
    times = []

    def tick():
        times.append(handler.event_loop.current_time)
        handler.event_loop.schedule_event(handler.event_loop.current_time + 0.5, tick)

    handler = Scheduling(0.5, tick)
    run(make_scenario(), handlers=[handler])
    assert times == pytest.approx([0.5, 1.0, 1.5, 2.0])


def test_the_number_of_pending_events(make_scenario):
    handler = Watching()
    IntegratedRun(make_scenario(), handlers=[handler])
    before = len(handler.event_loop)
    handler.event_loop.schedule_event(1, print)
    assert len(handler.event_loop) == before + 1


@pytest.mark.parametrize("time", [-1, math.nan, math.inf, "soon", None])
def test_a_time_that_is_none(make_scenario, time):
    handler = Watching()
    IntegratedRun(make_scenario(), handlers=[handler])
    with pytest.raises(EventLoopException, match="after"):
        handler.event_loop.schedule_event(time, print)


def test_a_time_in_the_past(make_scenario):
    handler = Scheduling(1.0, lambda: handler.event_loop.schedule_event(0.5, print))
    with pytest.raises(EventLoopException, match=r"0\.5.* 1\.0 s"):
        run(make_scenario(), handlers=[handler])


def test_a_callback_that_cannot_be_called(make_scenario):
    handler = Watching()
    IntegratedRun(make_scenario(), handlers=[handler])
    with pytest.raises(EventLoopException, match="3"):
        handler.event_loop.schedule_event(1, 3)


def test_what_the_event_loop_has_not_is_said_with_the_mode(make_scenario):
    handler = Watching()
    IntegratedRun(make_scenario(), handlers=[handler])
    with pytest.raises(AttributeError, match="'pop_event'"):
        handler.event_loop.pop_event()


def test_what_an_event_raises_ends_the_run(make_scenario):
    def fail():
        raise LookupError("spoilt")

    handler = Scheduling(0.5, fail)
    integrated_run = IntegratedRun(make_scenario(), handlers=[handler])
    with pytest.raises(LookupError, match="spoilt"):
        integrated_run.execute()
    assert (integrated_run.result().sim_time_s, integrated_run.result().interrupted) == (0.5, True)
    assert handler.ended == 1


def test_nodes_have_id_protocol_seed_and_live_position(make_scenario):
    class Looking(Watching):
        def initialize(self):
            self.seen = []
            self.event_loop.schedule_event(1.0, lambda: self.seen.append(self.nodes[0].position))

    handler = Looking()
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    def initialize(self):\n"
        "        self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 0, 100))",
        "seed-set = 7",
    )
    run(scenario, handlers=[handler])
    assert [node.id for node in handler.nodes] == [0, 1]
    assert [node.seed for node in handler.nodes] == [7, 7]
    assert [type(node.protocol_encapsulator.protocol).__name__ for node in handler.nodes] == ["Tested"] * 2
    assert handler.seen == [pytest.approx((0, 0, 10))]
    assert handler.nodes[0].position == pytest.approx((0, 0, 20.5))


def test_nodes_cannot_be_moved(make_scenario):
    handler = Watching()
    IntegratedRun(make_scenario(), handlers=[handler])
    with pytest.raises(AttributeError, match="node 1"):
        handler.nodes[1].position = (0, 0, 0)
