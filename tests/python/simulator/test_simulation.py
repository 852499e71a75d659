import asyncio
import csv
import gc
import logging
import math
import random
import time
import weakref

import pytest

from gradysim.encapsulator.random_stream import random_stream
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin
from gradysim.simulator import pacing, simulation
from gradysim.simulator.handler.communication import CommunicationHandler
from gradysim.simulator.handler.interface import IAsyncNodeHandler, INodeHandler
from gradysim.simulator.handler.mobility import MobilityHandler
from gradysim.simulator.handler.timer import TimerException, TimerHandler
from gradysim.simulator.simulation import (
    PositionScheme,
    SimulationBuilder,
    SimulationConfiguration,
    Simulator,
)


class Protocol(IProtocol):
    """Does nothing; keeps the callbacks of all instances in the class's `calls`: (name, id, *arguments)."""

    calls: list

    def note(self, name, *arguments):
        self.calls.append((name, self.provider.get_id(), *arguments))

    def initialize(self):
        self.note("initialize")

    def handle_timer(self, timer):
        self.note("handle_timer", timer)

    def handle_packet(self, message):
        self.note("handle_packet", message)

    def handle_telemetry(self, telemetry):
        self.note("handle_telemetry", telemetry)

    def finish(self):
        self.note("finish")


class Recorder(INodeHandler):
    """A handler that keeps what it is called with."""

    def __init__(self, calls):
        self.calls = calls

    @staticmethod
    def get_label():
        return "recorder"

    def inject(self, event_loop):
        self.calls.append(("inject",))

    def register_node(self, node):
        self.calls.append(("register_node", node.id))

    def initialize(self):
        self.calls.append(("handler initialize",))

    def after_simulation_step(self, iteration, timestamp):
        self.calls.append(("after_simulation_step", iteration, timestamp))

    def finalize(self):
        self.calls.append(("finalize",))


@pytest.fixture(autouse=True)
def _no_log_handler_stays():
    root = logging.getLogger()
    before = (list(root.handlers), root.level)
    yield
    assert (root.handlers, root.level) == before


def protocol(**methods):
    """Make a protocol class with callbacks of its own."""
    return type("Tested", (Protocol,), {"calls": [], **methods})


def timers(*times):
    def initialize(self):
        for due in times:
            self.provider.schedule_timer(f"{due:g}", due)

    return protocol(initialize=initialize)


def build(tested, *, nodes=1, handlers=(), **configuration):
    builder = SimulationBuilder(SimulationConfiguration(**configuration))
    for handler in (TimerHandler(), *handlers):
        builder.add_handler(handler)
    for _ in range(nodes):
        builder.add_node(tested, (0, 0, 0))
    return builder.build()


def fired(tested):
    return [call[2] for call in tested.calls if call[0] == "handle_timer"]


# Building


def test_ids_count_from_zero():
    builder = SimulationBuilder()
    assert [builder.add_node(protocol(), (0, 0, 0)) for _ in range(3)] == [0, 1, 2]


def test_a_node_has_its_position_and_protocol():
    tested = protocol()
    builder = SimulationBuilder()
    builder.add_node(tested, [1, 2, 3])
    node = builder.build().get_node(0)
    assert (node.id, node.position, type(node.protocol_encapsulator.protocol)) == (0, (1.0, 2.0, 3.0), tested)


def test_adding_a_handler_returns_the_builder():
    builder = SimulationBuilder()
    assert builder.add_handler(TimerHandler()) is builder


def test_the_last_handler_of_a_label_wins():
    calls = []
    builder = SimulationBuilder()
    builder.add_handler(Recorder([])).add_handler(Recorder(calls))
    builder.build()
    assert calls == [("inject",)]


def test_building_twice_makes_two_simulations():
    tested = timers(1)
    builder = SimulationBuilder(SimulationConfiguration(duration=2)).add_handler(TimerHandler())
    builder.add_node(tested, (0, 0, 0))
    for _ in range(2):
        builder.build().start_simulation()
    assert fired(tested) == ["1", "1"]


def test_an_unknown_node_is_an_error():
    with pytest.raises(KeyError, match=r"no node 5, only \[0\]"):
        build(protocol()).get_node(5)


def test_an_id_is_given_once():
    simulator = build(protocol())
    with pytest.raises(ValueError, match="id 0 already"):
        simulator.create_node((0, 0, 0), protocol(), 0)


@pytest.mark.parametrize("position", [(1, 2), (1, 2, math.nan), (1, 2, "x"), None, 5])
def test_a_malformed_position_is_refused(position):
    with pytest.raises(ValueError, match="three finite numbers"):
        SimulationBuilder().add_node(protocol(), position)


@pytest.mark.parametrize("wrong", [int, "text", None])
def test_what_is_no_protocol_class_is_refused(wrong):
    with pytest.raises(TypeError, match="protocol's class"):
        SimulationBuilder().add_node(wrong, (0, 0, 0))


def test_an_instance_of_a_protocol_is_refused():
    with pytest.raises(TypeError, match="protocol's class"):
        SimulationBuilder().add_node(protocol()(), (0, 0, 0))


@pytest.mark.parametrize("wrong", [TimerHandler, "text", None])
def test_what_is_no_handler_is_refused(wrong):
    with pytest.raises(TypeError, match="handler"):
        SimulationBuilder().add_handler(wrong)


def test_a_wrong_configuration_is_refused():
    with pytest.raises(ValueError, match="real_time"):
        Simulator({}, SimulationConfiguration(real_time=-1))


# The course of a simulation


def test_the_order_of_calls():
    calls = []
    tested = timers(1, 2)
    tested.calls = calls
    build(tested, nodes=2, handlers=[Recorder(calls)], max_iterations=2).start_simulation()
    assert calls == [
        ("inject",),
        ("register_node", 0),
        ("register_node", 1),
        ("handler initialize",),
        ("handle_timer", 0, "1"),
        ("after_simulation_step", 0, 1.0),
        ("handle_timer", 1, "1"),
        ("after_simulation_step", 1, 1.0),
        ("finish", 0),
        ("finish", 1),
        ("finalize",),
    ]


def test_nodes_are_initialized_in_the_order_of_their_ids():
    tested = protocol()
    build(tested, nodes=3).start_simulation()
    assert [call[1] for call in tested.calls if call[0] == "initialize"] == [0, 1, 2]


def test_it_ends_when_no_event_is_left():
    tested = timers(1, 2)
    simulator = build(tested)
    simulator.start_simulation()
    assert (fired(tested), simulator.current_time, simulator.iteration) == (["1", "2"], 2.0, 2)


def test_no_event_after_the_duration_happens():
    tested = timers(5, 5.0001)
    build(tested, duration=5).start_simulation()
    assert fired(tested) == ["5"]


def test_at_the_end_it_is_as_late_as_the_duration_says():
    times = []
    tested = timers(1, 7)
    tested.finish = lambda self: times.append(self.provider.current_time())
    build(tested, duration=5).start_simulation()
    assert times == [5]


def test_it_ends_after_so_many_events():
    tested = timers(1, 2, 3)
    build(tested, max_iterations=2).start_simulation()
    assert fired(tested) == ["1", "2"]


def test_without_any_event_it_begins_and_ends():
    tested = protocol()
    build(tested, max_iterations=0).start_simulation()
    assert tested.calls == [("initialize", 0), ("finish", 0)]


def test_a_cancelled_timer_does_not_hold_it_up():
    def handle_timer(self, timer):
        self.note("handle_timer", timer)
        self.provider.cancel_timer("100")

    tested = timers(1, 100)
    tested.handle_timer = handle_timer
    simulator = build(tested)
    simulator.start_simulation()
    assert (fired(tested), simulator.current_time) == (["1"], 1.0)


def test_stepping_runs_one_event_at_a_time():
    tested = timers(1, 2)
    simulator = build(tested)
    assert (simulator.step_simulation(), fired(tested)) == (True, ["1"])
    assert (simulator.step_simulation(), fired(tested)) == (False, ["1", "2"])
    assert (simulator.step_simulation(), tested.calls.count(("finish", 0))) == (False, 1)


def test_running_some_events_says_whether_it_goes_on():
    tested = timers(1, 2, 3)
    simulator = build(tested)
    assert (simulator.run_events(2), simulator.iteration, simulator.is_simulation_done()) == (True, 2, False)
    assert (simulator.run_events(2), simulator.iteration, simulator.is_simulation_done()) == (False, 3, True)


def test_who_stops_early_finishes_once():
    tested = timers(1, 2)
    simulator = build(tested, duration=10)
    simulator.run_events(1)
    simulator.finalize()
    simulator.finalize()
    assert (tested.calls.count(("finish", 0)), simulator.step_simulation(), simulator.current_time) == (
        1,
        False,
        1,
    )


def test_what_never_began_has_no_end():
    tested = protocol()
    build(tested).finalize()
    assert tested.calls == []


def test_two_simulations_step_by_step_are_as_each_alone():
    both = [timers(1, 2, 3), timers(1, 2, 3)]
    first, second = (build(tested) for tested in both)
    while first.step_simulation() | second.step_simulation():
        pass
    assert fired(both[0]) == fired(both[1]) == ["1", "2", "3"]


def test_nodes_talk_move_and_keep_time_together():
    def initialize(self):
        mission = MissionMobilityPlugin(self)
        mission.start_mission([(0, 0, 0), (3, 4, 0)])
        self.provider.schedule_timer("tick", 0.5)

    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))

    tested = protocol(initialize=initialize, handle_timer=handle_timer, handle_telemetry=lambda *_: None)
    simulator = build(tested, nodes=2, handlers=[MobilityHandler(), CommunicationHandler()], duration=2)
    simulator.start_simulation()
    assert tested.calls == [
        ("handle_packet", 1, "hello"),
        ("handle_packet", 0, "hello"),
        ("finish", 0),
        ("finish", 1),
    ]
    assert [node.position for node in simulator.nodes] == [(3, 4, 0), (3, 4, 0)]


# Failures and interruptions


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


# Random numbers


def draws(**configuration):
    drawn = []

    def initialize(self):
        drawn.append((self.provider.random.random(), random.random()))

    simulator = build(protocol(initialize=initialize), nodes=2, **configuration)
    simulator.start_simulation()
    return drawn, simulator.seed


def test_the_same_seed_draws_the_same():
    assert draws(seed=5) == draws(seed=5)


def test_another_seed_draws_differently():
    assert draws(seed=5)[0] != draws(seed=6)[0]


def test_the_protocols_stream_has_a_name():
    assert draws(seed=5)[0][1][0] == random_stream(5, 1, "protocol").random()


def test_pythons_own_stream_starts_with_the_run():
    assert draws(seed=5)[0][0][1] == random.Random(5).random()


def test_without_a_seed_it_is_kept_for_the_next_time():
    drawn, seed = draws()
    assert draws(seed=seed) == (drawn, seed)


def test_who_seeded_pythons_stream_gets_the_same_run_again():
    def seeded():
        random.seed(3)
        return draws()

    assert seeded() == seeded()


# Time on the wall


class WallClock:
    def __init__(self):
        self.now = 0.0

    def monotonic(self):
        return self.now

    def sleep(self, duration_s):
        self.now += duration_s


@pytest.fixture
def wall(monkeypatch):
    clock = WallClock()
    monkeypatch.setattr(pacing, "time", clock)
    return clock


@pytest.mark.parametrize(("real_time", "wall_s"), [(False, 0), (0, 0), (True, 10), (4.0, 2.5)])
def test_real_time(wall, real_time, wall_s):
    build(timers(3, 10, 50), real_time=real_time, duration=20).start_simulation()
    assert wall.now == wall_s


def test_real_time_can_be_turned_off(wall):
    with simulation._ForceFastExecution():
        build(timers(10), real_time=True).start_simulation()
    assert wall.now == 0


def test_turning_real_time_off_ends_with_the_context(wall):
    with simulation._ForceFastExecution():
        pass
    build(timers(10), real_time=True).start_simulation()
    assert wall.now == 10


# The timing report


def report_of(folder):
    with (folder / "timing_report.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def test_the_timing_report(wall, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)

    def late(self, timer):
        wall.now += 3.0 if timer == "4" else 0.0

    tested = timers(4, 6, 20)
    tested.handle_timer = late
    build(tested, real_time=2, timing_report=True).start_simulation()
    columns = ["iteration", "simulation_time", "real_time", "time_until_next_event", "time_drift"]
    assert [[float(line[column]) for column in columns] for line in report_of(tmp_path)] == [
        [0, 4, 2, 2, 0],
        [1, 6, 5, -2, 2],
        [2, 20, 10, 5, 0],
    ]
    assert "2 asked for, 2.0000 reached" in capsys.readouterr().err


@pytest.mark.parametrize("configuration", [{"real_time": True}, {"timing_report": True}])
def test_there_is_a_timing_report_only_in_real_time_and_if_asked_for(
    wall, tmp_path, monkeypatch, configuration
):
    monkeypatch.chdir(tmp_path)
    build(timers(1), **configuration).start_simulation()
    assert list(tmp_path.iterdir()) == []


def test_the_timing_report_is_there_after_a_failure(wall, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tested = timers(1)
    tested.handle_timer = lambda self, timer: 1 / 0
    with pytest.raises(ZeroDivisionError):
        build(tested, real_time=True, timing_report=True).start_simulation()
    assert len(report_of(tmp_path)) == 1


# Asyncio


class Asynchronous(IAsyncNodeHandler):
    """Runs a coroutine function, given itself, from `initialize` on."""

    def __init__(self, work=None):
        self.work = work
        self.calls = []

    @staticmethod
    def get_label():
        return "asynchronous"

    def inject(self, event_loop):
        self.event_loop = event_loop
        self.calls.append("inject")

    def inject_async(self, asyncio_loop, real_time):
        self.asyncio_loop = asyncio_loop
        self.calls.append(("inject_async", real_time, asyncio_loop.is_running()))

    def register_node(self, node):
        self.calls.append("register_node")

    def initialize(self):
        if self.work is not None:
            self.task = self.asyncio_loop.create_task(self.work(self))


@pytest.mark.parametrize(("real_time", "factor"), [(False, 0.0), (True, 1.0), (2, 2.0)])
def test_an_asyncio_handler_gets_the_loop_after_inject(real_time, factor):
    handler = Asynchronous()
    build(protocol(), handlers=[handler], real_time=real_time)
    assert handler.calls == ["inject", ("inject_async", factor, False), "register_node"]


def test_tasks_run_between_events():
    async def work(handler):
        for _ in range(10):
            handler.calls.append(handler.event_loop.current_time)
            await asyncio.sleep(0)

    handler = Asynchronous(work)
    build(timers(1, 2, 3), handlers=[handler]).start_simulation()
    assert handler.calls[3:] == [0.0, 1.0, 2.0, 3.0]


def test_a_task_brings_an_event_forward_in_real_time():
    async def work(handler):
        handler.event_loop.schedule_event(0.001, lambda: handler.calls.append("brought forward"))

    handler = Asynchronous(work)
    simulator = build(timers(3600), handlers=[handler], real_time=True)
    simulator.run_events(1)
    assert handler.calls[-1] == "brought forward"
    simulator.finalize()


def test_in_real_time_events_come_when_they_are_due(monkeypatch):
    handler = Asynchronous()
    simulator = build(timers(0.01, 0.03), handlers=[handler], real_time=True)
    start = time.monotonic()
    simulator.start_simulation()
    assert time.monotonic() - start >= 0.03


def test_what_a_task_raises_ends_the_simulation():
    async def work(handler):
        raise RuntimeError("of a task")

    handler = Asynchronous(lambda handler: work(handler))
    simulator = build(timers(1, 2, 3), handlers=[handler])

    def forget():
        handler.task = None

    handler.initialize = lambda: (Asynchronous.initialize(handler), forget())
    with pytest.raises(RuntimeError, match="of a task"):
        simulator.start_simulation()


def test_in_the_end_tasks_are_cancelled_and_the_loop_is_closed():
    async def work(handler):
        try:
            await asyncio.Event().wait()
        finally:
            handler.calls.append("cancelled")

    handler = Asynchronous(work)
    build(timers(1), handlers=[handler]).start_simulation()
    assert (handler.calls[-1], handler.asyncio_loop.is_closed()) == ("cancelled", True)


def test_handlers_may_use_the_loop_in_their_own_methods():
    handler = Asynchronous()
    handler.finalize = lambda: handler.asyncio_loop.run_until_complete(asyncio.sleep(0))
    build(timers(1), handlers=[handler]).start_simulation()


def test_a_simulation_that_never_began_leaves_no_open_loop():
    handler = Asynchronous()
    simulator = build(protocol(), handlers=[handler])
    del simulator
    gc.collect()
    assert handler.asyncio_loop.is_closed()


# The log


def test_simulations_stepped_in_turn_log_their_own_lines(tmp_path):
    def logs(name):
        def handle_timer(self, timer):
            logging.getLogger(name).info("%s at %s", name, timer)

        tested = timers(1, 2)
        tested.handle_timer = handle_timer
        return tested

    simulators = [build(logs(name), log_file=tmp_path / name) for name in ("first", "second")]
    while sum(simulator.step_simulation() for simulator in simulators) > 0:
        pass
    for name in ("first", "second"):
        lines = (tmp_path / name).read_text().splitlines()
        assert [line.split("] ")[-1] for line in lines[1:3]] == [f"{name} at 1", f"{name} at 2"]
        assert sum("finished" in line for line in lines) == sum("started" in line for line in lines) == 1


def test_lines_say_when_and_to_whom(capsys):
    def handle_timer(self, timer):
        logging.getLogger().info("hello")

    tested = timers(7.5)
    tested.handle_timer = handle_timer
    build(tested).start_simulation()
    assert "INFO     [it=0 time=0:00:07.500000 | Tested 0 handle_timer] hello\n" in capsys.readouterr().err


def test_the_course_of_the_simulation_is_logged(capsys):
    build(timers(1)).start_simulation()
    lines = capsys.readouterr().err
    assert "Simulation started" in lines
    assert "Simulation finished" in lines
    assert "Total iterations: 1\tSimulation time: 0:00:01" in lines


def test_the_log_can_be_turned_off(capsys):
    build(timers(1), execution_logging=False).start_simulation()
    assert capsys.readouterr().err == ""


def test_the_log_goes_to_a_file_too(tmp_path):
    build(timers(1), log_file=tmp_path / "run.log").start_simulation()
    assert "Simulation finished" in (tmp_path / "run.log").read_text()


def test_the_profile_is_logged_at_the_end(capsys):
    build(timers(1, 2), profile=True, execution_logging=False).start_simulation()
    assert ["Tested", "0", "handle_timer", "2"] in [
        line.split()[:4] for line in capsys.readouterr().err.splitlines()
    ]


def test_a_dropped_simulation_leaves_no_log_handler():
    simulator = build(timers(1, 2))
    simulator.step_simulation()
    del simulator
    gc.collect()


def test_a_simulation_that_ended_is_not_kept():
    simulator = build(timers(1))
    simulator.start_simulation()
    gone = weakref.ref(simulator)
    del simulator
    gc.collect()
    assert gone() is None


def test_the_scope_of_a_line_can_be_set(capsys):
    simulator = build(timers(1, 2))
    simulator.step_simulation()
    simulator.scope_event(41, 60, "elsewhere")
    logging.getLogger().info("hello")
    simulator.finalize()
    assert "[it=41 time=0:01:00 | elsewhere] hello" in capsys.readouterr().err


def test_the_names_of_the_published_module_are_here():
    assert {"PositionScheme", "SimulationBuilder", "SimulationConfiguration", "Simulator"} <= set(
        vars(simulation)
    )
    assert simulation.PositionScheme is PositionScheme
