"""The connection to the compiled engine, tested with the engine itself."""

import gc
from weakref import ref

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

from gradysim import _netsim
from gradysim.encapsulator.netsim import NetsimEncapsulator, NetsimProvider
from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.protocol.errors import CommunicationException, MasslessMobilityException, TimerException
from gradysim.protocol.messages.communication import (
    BroadcastMessageCommand,
    CommunicationCommand,
    SendMessageCommand,
)
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
    SetSpeedMobilityCommand,
)
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.position import geo_to_cartesian
from python.recording_protocol import RecordingProtocol

ORIGIN = (-22.9, -43.2, 10.0)


class Recorder(RecordingProtocol):
    """Logs its calls and their times; `script` maps the name of a callback to an action."""

    script: dict = {}  # noqa: RUF012 - set per test by `encapsulated`

    def note(self, name, *arguments):
        given = () if name == "handle_telemetry" else arguments
        super().note(round(self.provider.current_time(), 9), name, *given)
        if name in self.script:
            self.script[name](self)


class Pair:
    """Two nodes, 10 m apart, on an ideal channel. Node 0 follows the script, node 1 only receives."""

    def __init__(self, seed=0, **script):
        self.network = _netsim.Network(_netsim.MediumConfig("UnitDiskRadioMedium"), seed)
        self.encapsulators = []
        for index in range(2):
            config = _netsim.NodeConfig(f"node[{index}]")
            config.wlan[0].radio.communication_range_m = 100.0
            config.initial_position = (10.0 * index, 0.0, 0.0)
            config.mobility.telemetry_interval_s = 0.0
            node = self.network.add_node(config)
            provider = NetsimProvider(node, seed=seed, reference_coordinates=ORIGIN)
            encapsulator = NetsimEncapsulator(node, provider)
            encapsulator.encapsulate(type("Scripted", (Recorder,), {"script": script if index == 0 else {}}))
            self.encapsulators.append(encapsulator)

    def run(self, until_s=2.0):
        self.network.initialize()
        self.network.run_until(until_s)
        self.network.finish()
        self.network.release_protocols()
        return self

    def calls(self, index=0):
        return self.encapsulators[index].protocol.calls


def test_every_callback_may_be_empty():
    assert Pair().run().calls() == [(0.0, "initialize"), (2.0, "finish")]


def test_ids_count_from_0():
    assert [encapsulator.provider.get_id() for encapsulator in Pair().encapsulators] == [0, 1]


def test_made_without_the_other_nodes_it_does_not_know_where_they_are():
    with pytest.raises(RuntimeError):
        Pair().encapsulators[0].provider.node_positions()


def test_a_timer_is_due_at_its_time():
    def initialize(protocol):
        protocol.provider.schedule_timer("tick", 1.25)

    assert (1.25, "handle_timer", "tick") in Pair(initialize=initialize).run().calls()


def test_a_cancelled_timer_is_not():
    def initialize(protocol):
        protocol.provider.schedule_timer("tick", 1)
        protocol.provider.schedule_timer("tick", 1.5)
        protocol.provider.cancel_timer("tick")

    assert Pair(initialize=initialize).run().calls() == [(0.0, "initialize"), (2.0, "finish")]


def test_a_timer_in_the_past_is_an_error():
    def handle_timer(protocol):
        protocol.provider.schedule_timer("late", 0.5)

    def initialize(protocol):
        protocol.provider.schedule_timer("tick", 1)

    with pytest.raises(TimerException) as failure:
        Pair(initialize=initialize, handle_timer=handle_timer).run()
    assert failure.value.__notes__ == ["in handle_timer of node 0 (Scripted 0) at 1 s of simulated time"]


@pytest.mark.parametrize("command", [BroadcastMessageCommand("hällo {}"), SendMessageCommand("hällo {}", 1)])
def test_any_text_arrives_as_it_was_sent(command):
    def initialize(protocol):
        protocol.provider.send_communication_command(command)

    pair = Pair(initialize=initialize).run()
    assert [call[1:] for call in pair.calls(1)][1:-1] == [("handle_packet", "hällo {}")]


def test_an_unknown_destination_is_an_error():
    def initialize(protocol):
        protocol.provider.send_communication_command(SendMessageCommand("a", 7))

    with pytest.raises(CommunicationException, match="7"):
        Pair(initialize=initialize).run()


@pytest.mark.parametrize(
    ("exception", "method", "arguments", "value"),
    [
        (TimerException, "schedule_timer", ("tick", "5"), "'5'"),
        (TimerException, "schedule_timer", (5, 1), "5"),
        (TimerException, "cancel_timer", (5,), "5"),
        (CommunicationException, "send_communication_command", (CommunicationCommand(1.0, "hello"),), "1.0"),
        (CommunicationException, "send_communication_command", ("hello",), "'hello'"),
        (MasslessMobilityException, "send_mobility_command", ("hello",), "'hello'"),
    ],
)
def test_an_argument_of_the_wrong_type_is_refused_with_its_value(exception, method, arguments, value):
    provider = Pair().encapsulators[0].provider
    with pytest.raises(exception) as failure:
        getattr(provider, method)(*arguments)
    assert value in str(failure.value)


def position_after(command, until_s=1.0):
    def initialize(protocol):
        protocol.provider.send_mobility_command(SetSpeedMobilityCommand(1000))
        protocol.provider.send_mobility_command(command)

    pair = Pair(initialize=initialize)
    pair.network.initialize()
    pair.network.run_until(until_s)
    return pair.encapsulators[0]._node.position


def test_a_flight_to_coordinates():
    assert position_after(GotoCoordsMobilityCommand(30, 40, 5)) == pytest.approx((30, 40, 5))


def test_a_flight_to_geographic_coordinates_is_relative_to_the_origin():
    target = (-22.8999, -43.2001, 15.0)
    assert position_after(GotoGeoCoordsMobilityCommand(*target)) == pytest.approx(
        geo_to_cartesian(ORIGIN, target)
    )


def test_a_geographic_target_without_altitude_is_an_error():
    with pytest.raises(MasslessMobilityException, match="altitude"):
        position_after(MobilityCommand(MobilityCommandType.GOTO_GEO_COORDS, 1.0, 2.0))


def test_random_numbers_follow_from_the_seed_and_the_id():
    drawn = [encapsulator.provider.random.random() for encapsulator in Pair(seed=9).encapsulators]
    assert drawn == [RandomStream(9, identifier, Purpose.PROTOCOL).random() for identifier in range(2)]


def test_a_tracked_value_that_is_replaced_is_kept_nowhere():
    provider = Pair().encapsulators[0].provider
    provider.tracked_variables["place"] = place = frozenset([1.5])
    kept = ref(place)
    del place
    provider.tracked_variables["place"] = None
    gc.collect()
    assert kept() is None


def test_a_dict_that_replaces_the_tracked_variables_is_followed():
    provider = Pair().encapsulators[0].provider
    provider.tracked_variables["a"] = 1
    provider.tracked_variables = replacement = {"b": 2}
    replacement["c"] = 3
    assert provider.tracked_variables == {"b": 2, "c": 3}


def test_a_plugin_that_re_binds_a_callback_is_honoured():
    seen = []

    def initialize(protocol):
        def on_timer(_, timer):
            seen.append(timer)
            return DispatchReturn.INTERRUPT

        create_dispatcher(protocol).register_handle_timer(on_timer)
        protocol.provider.schedule_timer("tick", 1)

    pair = Pair(initialize=initialize).run()
    assert seen == ["tick"]
    assert pair.calls() == [(0.0, "initialize"), (2.0, "finish")]


@pytest.mark.parametrize("name", ["schedule_timer", "cancel_timer", "current_time", "get_id"])
def test_a_call_goes_straight_to_the_engine(name):
    encapsulator = Pair().encapsulators[0]
    assert getattr(encapsulator.provider, name) == getattr(encapsulator._node, name)


def test_the_methods_of_the_class_do_the_same():
    pair = Pair()
    provider = pair.encapsulators[0].provider
    NetsimProvider.schedule_timer(provider, "kept", 1.0)
    NetsimProvider.schedule_timer(provider, "dropped", 1.0)
    NetsimProvider.cancel_timer(provider, "dropped")
    NetsimProvider.send_communication_command(provider, BroadcastMessageCommand("a"))
    assert (NetsimProvider.current_time(provider), NetsimProvider.get_id(provider)) == (0.0, 0)
    pair.run()
    assert (1.0, "handle_timer", "kept") in pair.calls(0)
    assert len(pair.calls(0)) == 3
    assert [call[1:] for call in pair.calls(1)][1:-1] == [("handle_packet", "a")]


def test_a_failing_constructor_gets_a_note(monkeypatch):
    def fail(protocol):
        raise ArithmeticError

    monkeypatch.setattr(Recorder, "__init__", fail)
    with pytest.raises(ArithmeticError) as failure:
        Pair()
    assert failure.value.__notes__ == ["in __init__ of node 0 (Scripted 0) at 0 s of simulated time"]


def test_an_interrupt_gets_a_note():
    def initialize(protocol):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt) as interrupt:
        Pair(initialize=initialize).run()
    assert " initialize " in interrupt.value.__notes__[0]


def test_the_encapsulator_calls_the_protocol():
    encapsulator = Pair().encapsulators[0]
    encapsulator.initialize()
    encapsulator.handle_timer("tick")
    encapsulator.handle_packet("text")
    encapsulator.handle_telemetry(None)
    encapsulator.finish()
    assert [call[1] for call in encapsulator.protocol.calls] == [
        "initialize",
        "handle_timer",
        "handle_packet",
        "handle_telemetry",
        "finish",
    ]
