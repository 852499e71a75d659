"""The dispatcher calls the same handlers in the same order in both modes, also handlers registered later."""

from perfect_channel import Case
from watched_run import assert_same, trace_case

from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from python.quiet_protocol import Quiet

CASE = Case([(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (0.0, 10.0, 0.0)], telemetry_interval_s=0.1, duration_s=2.05)


class Dispatching(Quiet):
    """Handlers that stop every third event, register and unregister, and log the order of their calls."""

    def initialize(self) -> None:
        self.provider.tracked_variables["order"] = []
        self.count = 0
        self.dispatcher = create_dispatcher(self)
        self.dispatcher.register_handle_timer(self.second)
        self.dispatcher.register_handle_timer(self.first)
        self.dispatcher.register_handle_packet(self.first)
        self.dispatcher.register_handle_telemetry(self.second)
        self.dispatcher.register_finish(self.at_the_end)
        self.provider.schedule_timer("next", 0.03 * (1 + self.provider.get_id()))

    def note(self, what: str) -> None:
        self.provider.tracked_variables["order"] += [what]

    def first(self, protocol: "Dispatching", event: str) -> DispatchReturn:
        self.count += 1
        self.note(f"first {event}")
        if self.count % 3 == 0:
            self.dispatcher.register_handle_telemetry(self.passing)
            return DispatchReturn.INTERRUPT
        return DispatchReturn.CONTINUE

    def second(self, protocol: "Dispatching", event: str | Telemetry) -> None:
        self.note(f"second {event}")

    def passing(self, protocol: "Dispatching", telemetry: Telemetry) -> DispatchReturn:
        self.note("passing")
        self.dispatcher.unregister_handle_telemetry(self.passing)
        return DispatchReturn.INTERRUPT

    def at_the_end(self, protocol: "Dispatching") -> DispatchReturn:
        self.note("at the end")
        return DispatchReturn.INTERRUPT

    def handle_timer(self, timer: str) -> None:
        self.note(timer)
        self.provider.send_communication_command(BroadcastMessageCommand(f"{self.count} events so far"))
        self.provider.schedule_timer("next", self.provider.current_time() + 0.07)

    def handle_packet(self, message: str) -> None:
        self.note(message)
        if self.count < 20:
            self.provider.schedule_timer("again", self.provider.current_time() + 0.011)

    def finish(self) -> None:
        self.note("finish")


def test_the_same_order_of_handlers() -> None:
    integrated, prototype = (trace_case(mode, CASE, Dispatching) for mode in ("integrated", "prototype"))
    assert_same(integrated, prototype)
    for seen in ("first", "second", "passing", "at the end"):
        assert all(seen in tracked for tracked in integrated.tracked)
