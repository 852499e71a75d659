from hypothesis import given
from hypothesis import strategies as st
from simulated import Recorder, build, fired, protocol, timers

from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin
from gradysim.simulator.handler.communication import CommunicationHandler
from gradysim.simulator.handler.mobility import MobilityHandler


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


def test_ended_before_an_event_at_the_very_end_it_has_not_got_there():
    simulator = build(timers(1, 5), duration=5)
    simulator.run_events(1)
    simulator.finalize()
    assert simulator.current_time == 1


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


def test_stepping_gets_to_the_event_at_the_very_end():
    tested = timers(1, 5)
    simulator = build(tested, duration=5)
    while simulator.step_simulation():
        pass
    assert fired(tested) == ["1", "5"]


@given(
    due=st.lists(st.integers(0, 6), max_size=6),
    duration=st.none() | st.integers(1, 6),
    max_iterations=st.none() | st.integers(0, 8),
)
def test_stepping_is_the_same_as_running_at_once(due, duration, max_iterations):
    courses = []
    for step_by_step in (False, True):
        tested = timers(*due)
        recorder = Recorder(tested.calls)
        limits = {"duration": duration, "max_iterations": max_iterations}
        simulator = build(tested, nodes=2, handlers=[recorder], execution_logging=False, **limits)
        if step_by_step:
            while simulator.step_simulation():
                pass
        else:
            simulator.start_simulation()
        courses.append((tested.calls, simulator.iteration, simulator.current_time))
    assert courses[0] == courses[1]


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
