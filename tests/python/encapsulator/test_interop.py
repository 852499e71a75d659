import pytest

from gradysim.encapsulator.interop import ConsequenceType, InteropEncapsulator
from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from python.recording_protocol import RecordingProtocol


class Script(RecordingProtocol):
    """Executes the actions of `do` in each callback."""

    do = staticmethod(lambda protocol: None)

    def note(self, *call):
        super().note(*call)
        self.do(self)


def encapsulated(do):
    encapsulator = InteropEncapsulator()
    encapsulator.set_id(4)
    encapsulator.set_timestamp(2.5)
    encapsulator.encapsulate(type("Script", (Script,), {"do": staticmethod(do)}))
    return encapsulator


CALLBACKS = [
    ("initialize", ()),
    ("handle_timer", ("tick",)),
    ("handle_packet", ("hello",)),
    ("handle_telemetry", (Telemetry((1, 2, 3)),)),
    ("finish", ()),
]


def replace_tracked_variables(protocol):
    protocol.provider.tracked_variables = {"b": 2}


def test_the_types_have_the_published_numbers():
    assert [(kind.name, kind.value) for kind in ConsequenceType] == [
        ("COMMUNICATION", 0),
        ("MOBILITY", 1),
        ("TIMER", 2),
        ("TRACK_VARIABLE", 3),
        ("CANCEL_TIMER", 4),
    ]


@pytest.mark.parametrize(
    ("do", "consequence"),
    [
        (
            lambda p: p.provider.send_communication_command(SendMessageCommand("a", 1)),
            (ConsequenceType.COMMUNICATION, SendMessageCommand("a", 1)),
        ),
        (
            lambda p: p.provider.send_mobility_command(GotoCoordsMobilityCommand(1, 2, 3)),
            (ConsequenceType.MOBILITY, GotoCoordsMobilityCommand(1, 2, 3)),
        ),
        (lambda p: p.provider.schedule_timer("t", 5.0), (ConsequenceType.TIMER, ("t", 5.0))),
        (lambda p: p.provider.cancel_timer("t"), (ConsequenceType.CANCEL_TIMER, "t")),
        (
            lambda p: p.provider.tracked_variables.update(a=1),
            (ConsequenceType.TRACK_VARIABLE, ("a", 1)),
        ),
        (replace_tracked_variables, (ConsequenceType.TRACK_VARIABLE, ("b", 2))),
    ],
)
def test_what_the_protocol_does_is_a_consequence(do, consequence):
    assert encapsulated(do).initialize() == [consequence]


@pytest.mark.parametrize(("callback", "arguments"), CALLBACKS)
def test_every_callback_reaches_the_protocol_and_returns_consequences(callback, arguments):
    encapsulator = encapsulated(lambda p: p.provider.cancel_timer("t"))
    assert getattr(encapsulator, callback)(*arguments) == [(ConsequenceType.CANCEL_TIMER, "t")]
    assert encapsulator.protocol.calls == [(callback, *arguments)]


def test_consequences_come_in_order():
    def do(protocol):
        protocol.provider.schedule_timer("t", 3.0)
        protocol.provider.cancel_timer("t")
        protocol.provider.schedule_timer("t", 4.0)

    assert [kind for kind, _ in encapsulated(do).initialize()] == [
        ConsequenceType.TIMER,
        ConsequenceType.CANCEL_TIMER,
        ConsequenceType.TIMER,
    ]


def test_consequences_are_given_once():
    encapsulator = encapsulated(
        lambda p: p.provider.cancel_timer("t") if p.calls == [("initialize",)] else None
    )
    encapsulator.initialize()
    assert encapsulator.handle_timer("tick") == []


def test_a_command_changed_later_stays_as_it_was_sent():
    def do(protocol):
        command = BroadcastMessageCommand("first")
        protocol.provider.send_communication_command(command)
        command.message = "second"
        protocol.provider.send_communication_command(command)

    assert [command.message for _, command in encapsulated(do).initialize()] == ["first", "second"]


def test_time_and_id_are_the_hosts():
    encapsulator = encapsulated(lambda p: None)
    provider = encapsulator.protocol.provider
    assert (provider.current_time(), provider.get_id()) == (2.5, 4)


def test_replacing_the_tracked_variables_reports_what_is_gone():
    encapsulator = encapsulated(replace_tracked_variables)
    encapsulator.provider.tracked_variables["a"] = 1
    encapsulator.provider.consequences.clear()
    assert encapsulator.initialize() == [
        (ConsequenceType.TRACK_VARIABLE, ("a", None)),
        (ConsequenceType.TRACK_VARIABLE, ("b", 2)),
    ]
    assert encapsulator.provider.tracked_variables == {"b": 2}


def test_the_stream_is_the_runs():
    encapsulator = encapsulated(lambda p: None)
    encapsulator.set_seed(9)
    assert encapsulator.provider.random.random() == RandomStream(9, 4, Purpose.PROTOCOL).random()


def test_an_exception_passes_with_a_note():
    def fail(protocol):
        raise LookupError("broken")

    with pytest.raises(LookupError, match="broken") as raised:
        encapsulated(fail).handle_packet("hello")
    assert raised.value.__notes__ == ["in handle_packet of node 4 (Script 4) at 2.5 s of simulated time"]


def test_the_consequences_of_a_failed_callback_are_dropped():
    def fail_first(protocol):
        if len(protocol.calls) == 1:
            protocol.provider.cancel_timer("t")
            raise LookupError("broken")

    encapsulator = encapsulated(fail_first)
    with pytest.raises(LookupError):
        encapsulator.initialize()
    assert encapsulator.finish() == []


def test_the_stream_goes_on_from_draw_to_draw():
    provider = InteropEncapsulator().provider
    assert provider.random is provider.random
