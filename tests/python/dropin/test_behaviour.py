"""What users' protocols and scripts rely on, and where the published package was wrong."""

import logging
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.encapsulator.interop import ConsequenceType, InteropEncapsulator
from gradysim.protocol.interface import IProtocol, IProvider
from gradysim.protocol.messages.communication import (
    BroadcastMessageCommand,
    CommunicationCommand,
    CommunicationCommandType,
    SendMessageCommand,
)
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.plugin.follow_mobility import (
    MobilityFollowerConfiguration,
    MobilityFollowerPlugin,
    MobilityLeaderConfiguration,
    MobilityLeaderPlugin,
)
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin, MissionMobilityPluginException
from gradysim.protocol.plugin.random_mobility import RandomMobilityPlugin
from gradysim.protocol.position import geo_to_cartesian
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.communication import CommunicationException, CommunicationHandler
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.mobility import (
    MobilityHandler,
)
from gradysim.simulator.handler.timer import TimerException, TimerHandler
from gradysim.simulator.handler.visualization import VisualizationHandler
from gradysim.simulator.node import Node
from gradysim.simulator.simulation import (
    PositionScheme,
    SimulationBuilder,
    SimulationConfiguration,
    Simulator,
    _ForceFastExecution,
)


class Quiet(IProtocol):
    """Does nothing; the tests override what they need."""

    def initialize(self) -> None: ...

    def handle_timer(self, timer: str) -> None: ...

    def handle_packet(self, message: str) -> None: ...

    def handle_telemetry(self, telemetry: Telemetry) -> None: ...

    def finish(self) -> None: ...


class Provider(IProvider):
    """A user's own environment, written against the published interface: all that it has is a clock."""

    now = 0.0

    def send_communication_command(self, command: CommunicationCommand) -> None: ...

    def send_mobility_command(self, command: MobilityCommand) -> None: ...

    def schedule_timer(self, timer: str, timestamp: float) -> None: ...

    def cancel_timer(self, timer: str) -> None: ...

    def current_time(self) -> float:
        return self.now

    def get_id(self) -> int:
        return 4


def simulation(
    *protocols: type[IProtocol], handlers: tuple[INodeHandler, ...] | None = None, **configuration: Any
) -> Simulator:
    """A simulation of nodes at the origin, with timers and communication if nothing else is said."""
    builder = SimulationBuilder(
        SimulationConfiguration(**{"duration": 10, "execution_logging": False} | configuration)
    )
    for handler in (TimerHandler(), CommunicationHandler()) if handlers is None else handlers:
        builder.add_handler(handler)
    for protocol in protocols:
        builder.add_node(protocol, (0, 0, 0))
    return builder.build()


# ---- messages and positions -----------------------------------------------------------------------------


def test_unused_parameters_of_a_mobility_command_are_none() -> None:
    command = MobilityCommand(MobilityCommandType.GOTO_COORDS)
    assert [getattr(command, f"param_{number}") for number in range(1, 7)] == [None] * 6


@pytest.mark.parametrize(
    ("command", "kind", "parameters"),
    [
        (GotoCoordsMobilityCommand(1, 2, 3), MobilityCommandType.GOTO_COORDS, (1, 2, 3)),
        (GotoGeoCoordsMobilityCommand(1, 2, 3), MobilityCommandType.GOTO_GEO_COORDS, (1, 2, 3)),
        (SetSpeedMobilityCommand(1), MobilityCommandType.SET_SPEED, (1, None, None)),
        (SetVelocityMobilityCommand(1, 2, 3), MobilityCommandType.SET_SPEED, (1, 2, 3)),
    ],
)
def test_mobility_commands_fill_in_type_and_parameters(
    command: MobilityCommand, kind: MobilityCommandType, parameters: tuple[float | None, ...]
) -> None:
    assert command.command_type is kind
    assert (command.param_1, command.param_2, command.param_3) == parameters


def test_a_broadcast_has_no_destination() -> None:
    assert BroadcastMessageCommand("hi").destination is None


def test_a_command_equals_only_one_of_its_own_class() -> None:
    assert SendMessageCommand("a", 1) == SendMessageCommand("a", 1)
    assert SendMessageCommand("a", 1) != CommunicationCommand(CommunicationCommandType.SEND, "a", 1)


def test_types_of_commands_are_numbers() -> None:
    assert isinstance(CommunicationCommandType.SEND, int)
    assert isinstance(MobilityCommandType.GOTO_COORDS, int)


def test_north_and_east_have_their_own_signs() -> None:
    x, y, z = geo_to_cartesian((10, 10, 0), (9.999, 10.001, 5))
    assert (x, y, z) == pytest.approx((-111.19, 109.51, 5), abs=0.01)


def test_a_protocol_is_made_without_arguments_and_then_given_its_provider() -> None:
    class Constructed(Quiet):
        def __init__(self) -> None:
            self.had_provider = hasattr(self, "provider")

    provider: Any = object()
    protocol = Constructed.instantiate(provider)
    assert (protocol.had_provider, protocol.provider) == (False, provider)


# ---- order and time -------------------------------------------------------------------------------------


def test_timers_of_one_instant_fire_in_the_order_of_their_setting() -> None:
    fired: list[str] = []

    class Timers(Quiet):
        def initialize(self) -> None:
            for number in range(12):
                self.provider.schedule_timer(str(number), 1)

        def handle_timer(self, timer: str) -> None:
            fired.append(timer)

    simulation(Timers).start_simulation()
    assert fired == [str(number) for number in range(12)]


def test_events_of_one_instant_come_out_in_the_order_in_which_they_went_in() -> None:
    loop = EventLoop()
    for number in range(12):
        loop.schedule_event(1, lambda: None, str(number))
    assert [loop.pop_event().context for _ in range(12)] == [str(number) for number in range(12)]


@pytest.mark.parametrize(("duration", "fired"), [(4.9, []), (5, ["late"])])
def test_nothing_happens_after_the_duration(duration: float, fired: list[str]) -> None:
    seen: list[str] = []

    class Late(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("late", 5)

        def handle_timer(self, timer: str) -> None:
            seen.append(timer)

    simulation(Late, duration=duration).start_simulation()
    assert seen == fired


def test_initialize_and_finish_go_by_id() -> None:
    calls: list[tuple[str, int]] = []

    class Called(Quiet):
        def initialize(self) -> None:
            calls.append(("initialize", self.provider.get_id()))

        def finish(self) -> None:
            calls.append(("finish", self.provider.get_id()))

    simulation(Called, Called).start_simulation()
    assert calls == [("initialize", 0), ("initialize", 1), ("finish", 0), ("finish", 1)]


def test_step_simulation_says_whether_it_goes_on() -> None:
    class Twice(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("", 1)
            self.provider.schedule_timer("", 2)

    simulator = simulation(Twice)
    assert [simulator.step_simulation() for _ in range(3)] == [True, False, False]
    assert simulator.is_simulation_done()


def test_max_iterations_ends_the_run() -> None:
    fired: list[str] = []

    class Timers(Quiet):
        def initialize(self) -> None:
            for number in range(5):
                self.provider.schedule_timer(str(number), number)

        def handle_timer(self, timer: str) -> None:
            fired.append(timer)

    simulation(Timers, max_iterations=2).start_simulation()
    assert fired == ["0", "1"]


def test_real_time_can_be_turned_off_for_tests() -> None:
    class Slow(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("in an hour", 3600)

    simulator = simulation(Slow, duration=None, real_time=True)
    with _ForceFastExecution():
        simulator.start_simulation()
    assert simulator.is_simulation_done()


# ---- failures -------------------------------------------------------------------------------------------


def test_an_exception_of_a_protocol_is_raised_and_says_where_it_was() -> None:
    class Broken(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("go", 2.5)

        def handle_timer(self, timer: str) -> None:
            raise RuntimeError("broken")

    with pytest.raises(RuntimeError, match="broken") as caught:
        simulation(Quiet, Broken).start_simulation()
    (note,) = caught.value.__notes__
    assert note == "in handle_timer of node 1 (Broken 1) at 2.5 s of simulated time"


def test_a_timer_in_the_past_is_an_exception() -> None:
    class Past(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("never", -1)

    with pytest.raises(TimerException, match="never"):
        simulation(Past).start_simulation()


@pytest.mark.parametrize(
    "command",
    [SendMessageCommand("to nobody", 7), SendMessageCommand("to itself", 0)],
    ids=lambda command: command.message,
)
def test_a_message_without_a_receiver_is_an_exception(command: CommunicationCommand) -> None:
    class Sender(Quiet):
        def initialize(self) -> None:
            self.provider.send_communication_command(command)

    with pytest.raises(CommunicationException):
        simulation(Sender, Quiet).start_simulation()


@pytest.mark.parametrize("content", [None, "1,2,3\n4,5\n"], ids=["missing", "malformed"])
def test_a_wrong_mission_file_is_an_exception(tmp_path: Path, content: str | None) -> None:
    file = tmp_path / "mission.txt"
    if content is not None:
        file.write_text(content)

    class Flyer(Quiet):
        def initialize(self) -> None:
            MissionMobilityPlugin(self).start_mission_with_waypoint_file(str(file))

    with pytest.raises(MissionMobilityPluginException, match=r"mission\.txt"):
        simulation(Flyer).start_simulation()


def test_a_negative_pace_is_an_exception() -> None:
    with pytest.raises(ValueError, match="real_time"):
        simulation(real_time=-1)


# ---- timers ---------------------------------------------------------------------------------------------


def test_a_callback_may_cancel_timers_of_its_own_name() -> None:
    fired: list[float] = []

    class Once(Quiet):
        def initialize(self) -> None:
            for time in (1, 2, 3):
                self.provider.schedule_timer("tick", time)

        def handle_timer(self, timer: str) -> None:
            fired.append(self.provider.current_time())
            self.provider.cancel_timer("tick")

    simulation(Once).start_simulation()
    assert fired == [1]


def test_a_cancellation_is_for_every_timer_of_that_name_and_of_that_node() -> None:
    fired: list[tuple[int, str]] = []

    class Timers(Quiet):
        def initialize(self) -> None:
            for name in ("a", "b", "a"):
                self.provider.schedule_timer(name, 1)
            if self.provider.get_id() == 0:
                self.provider.cancel_timer("a")
            self.provider.cancel_timer("unknown")

        def handle_timer(self, timer: str) -> None:
            fired.append((self.provider.get_id(), timer))

    simulation(Timers, Timers).start_simulation()
    assert fired == [(0, "b"), (1, "a"), (1, "b"), (1, "a")]


def test_a_host_outside_is_told_of_a_cancellation() -> None:
    class Cancels(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("tick", 1)
            self.provider.cancel_timer("tick")

    host = InteropEncapsulator()
    host.encapsulate(Cancels)
    host.set_id(3)
    host.set_timestamp(0)
    assert host.initialize() == [
        (ConsequenceType.TIMER, ("tick", 1)),
        (ConsequenceType.CANCEL_TIMER, "tick"),
    ]


# ---- plugins --------------------------------------------------------------------------------------------


def test_the_handler_registered_last_comes_first_and_may_end_the_event() -> None:
    calls: list[str] = []

    class Packets(Quiet):
        def handle_packet(self, message: str) -> None:
            calls.append("protocol")

    def first(protocol: IProtocol, message: str) -> DispatchReturn | None:
        calls.append("registered first")
        return None

    def last(protocol: IProtocol, message: str) -> DispatchReturn:
        calls.append("registered last")
        return DispatchReturn.INTERRUPT if message == "stop" else DispatchReturn.CONTINUE

    protocol = Packets()
    create_dispatcher(protocol).register_handle_packet(first)
    create_dispatcher(protocol).register_handle_packet(last)
    protocol.handle_packet("go")
    protocol.handle_packet("stop")
    assert calls == ["registered last", "registered first", "protocol", "registered last"]


def test_nobody_can_keep_finish_from_a_protocol() -> None:
    calls: list[str] = []

    class Finishes(Quiet):
        def finish(self) -> None:
            calls.append("finish")

    protocol = Finishes()
    create_dispatcher(protocol).register_finish(lambda protocol: DispatchReturn.INTERRUPT)
    protocol.finish()
    assert calls == ["finish"]


def test_the_timeout_of_followers_is_in_seconds() -> None:
    provider = Provider()
    protocol = Quiet.instantiate(provider)
    leader = MobilityLeaderPlugin(protocol, MobilityLeaderConfiguration(follower_timeout=5))
    protocol.handle_packet("FollowMobilityPlugin__follower:7")
    provider.now = 4.9
    for _ in range(100):
        protocol.handle_timer("FollowMobilityPlugin__leader_broadcast_timer")
    assert leader.followers == {7}
    provider.now = 5.1
    assert leader.followers == set()


@pytest.mark.parametrize(("auto_follow", "leader"), [(True, 2), (False, None)])
def test_a_follower_chooses_a_leader_only_if_it_may(auto_follow: bool, leader: int | None) -> None:
    protocol = Quiet.instantiate(Provider())
    follower = MobilityFollowerPlugin(protocol, MobilityFollowerConfiguration(auto_follow=auto_follow))
    for number in (3, 2):
        protocol.handle_packet(f'FollowMobilityPlugin__leader:{{"id": {number}, "position": [0, 0, 0]}}')
    protocol.handle_timer("FollowMobilityPlugin__follower_timer")
    assert follower.available_leaders == {2, 3}
    assert follower.current_leader == leader


def test_a_trip_can_be_asked_for_before_it_begins() -> None:
    seen: list[Any] = []

    class Idle(Quiet):
        def initialize(self) -> None:
            trip = RandomMobilityPlugin(self)
            trip.finish_random_trip()
            seen.extend([trip.trip_ongoing, trip.current_target])

    simulation(Idle).start_simulation()
    assert seen == [False, None]


def test_a_seed_repeats_the_draws_of_every_node() -> None:
    def draws() -> list[float]:
        drawn: list[float] = []

        class Draws(Quiet):
            def initialize(self) -> None:
                drawn.append(self.provider.random.random())

        simulation(Draws, Draws, seed=5).start_simulation()
        return drawn

    first, second = draws(), draws()
    assert first == second
    assert first[0] != first[1]


def test_a_provider_of_ones_own_needs_only_the_published_methods() -> None:
    assert 0 <= Quiet.instantiate(Provider()).provider.random.random() < 1


# ---- handlers -------------------------------------------------------------------------------------------


def test_commands_to_the_viewers_wait_in_a_queue() -> None:
    from gradysim.simulator.extension.visualization_controller import VisualizationController

    handler = VisualizationHandler()
    provider: Any = type("Provider", (), {"handlers": {"visualization": handler}})()
    VisualizationController(Quiet.instantiate(provider)).paint_node(0, (255, 0, 0))
    assert handler.command_queue.qsize() == 1
    assert handler.command_queue.get() == {
        "command": "paint_node",
        "payload": {"node_id": 0, "color": (255, 0, 0)},
    }
    assert handler.command_queue.empty()


@pytest.mark.parametrize(
    ("make", "label"),
    [
        (CommunicationHandler, "communication"),
        (TimerHandler, "timer"),
        (MobilityHandler, "mobility"),
        (VisualizationHandler, "visualization"),
    ],
)
def test_handlers_keep_their_labels(make: Callable[[], INodeHandler], label: str) -> None:
    assert make().get_label() == label


def test_a_handler_of_ones_own_may_take_the_place_of_ours() -> None:
    class Still(INodeHandler):
        def __init__(self) -> None:
            self.log: list[str] = []

        @staticmethod
        def get_label() -> str:
            return "mobility"

        def inject(self, event_loop: EventLoop) -> None:
            self.log.append("inject")

        def register_node(self, node: Node[Any]) -> None:
            self.log.append("register")

        def initialize(self) -> None:
            self.log.append("initialize")

        def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
            self.log.append(f"command of {node.id}")

        def after_simulation_step(self, iteration: int, timestamp: float) -> None:
            self.log.append(f"after {iteration} at {timestamp}")

        def finalize(self) -> None:
            self.log.append("finalize")

    class Mover(Quiet):
        def initialize(self) -> None:
            self.provider.send_mobility_command(SetSpeedMobilityCommand(1))
            self.provider.schedule_timer("", 2)

    still = Still()
    simulation(Mover, handlers=(TimerHandler(), MobilityHandler(), still)).start_simulation()
    assert still.log == ["inject", "register", "initialize", "command of 0", "after 0 at 2.0", "finalize"]


# ---- the simulator --------------------------------------------------------------------------------------


def test_ids_count_from_zero_in_the_order_of_adding() -> None:
    builder = SimulationBuilder()
    assert [builder.add_node(Quiet, (0, 0, 0)) for _ in range(3)] == [0, 1, 2]


def test_adding_a_handler_returns_the_builder() -> None:
    builder = SimulationBuilder()
    assert builder.add_handler(TimerHandler()) is builder


def test_the_protocol_of_a_node_can_be_reached_from_outside() -> None:
    simulator = simulation(Quiet)
    simulator.start_simulation()
    assert isinstance(simulator.get_node(0).protocol_encapsulator.protocol, Quiet)


def test_a_command_without_its_handler_is_a_warning(caplog: pytest.LogCaptureFixture) -> None:
    class Mover(Quiet):
        def initialize(self) -> None:
            self.provider.send_mobility_command(SetSpeedMobilityCommand(1))

    with caplog.at_level(logging.WARNING):
        simulation(Mover, handlers=(TimerHandler(),)).start_simulation()
    assert "mobility" in caplog.text


def test_simulations_leave_no_log_handlers_behind() -> None:
    before = list(logging.getLogger().handlers)
    for _ in range(3):
        simulation(Quiet, execution_logging=True).start_simulation()
    assert logging.getLogger().handlers == before


def test_lines_of_the_log_say_when_and_where(tmp_path: Path) -> None:
    class Talks(Quiet):
        def initialize(self) -> None:
            self.provider.schedule_timer("", 61.5)

        def handle_timer(self, timer: str) -> None:
            logging.getLogger("mine").info("here")

    file = tmp_path / "run.log"
    simulation(Talks, duration=100, execution_logging=True, log_file=file).start_simulation()
    assert "INFO     [it=0 time=0:01:01.500000 | Talks 0 handle_timer] here" in file.read_text().splitlines()


def test_random_positions_are_in_their_box() -> None:
    x, y, z = PositionScheme.random((1, 2), (3, 4), (5, 6))
    assert 1 <= x <= 2
    assert 3 <= y <= 4
    assert 5 <= z <= 6
