"""Protocols that execute a script in their callbacks, and a log of the callbacks."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from perfect_channel import Case

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.telemetry import Telemetry

TICKS_PER_S = 100
"""Timers are set for integers of ticks. So many events share an instant, telemetry among them."""

Entry = tuple[float, int, str, str]
"""A callback: time in seconds, node, method, argument."""


@dataclass(frozen=True)
class Action:
    """One action of a protocol.

    Attributes:
        kind: Kind of action; "draw" tracks a random number.
        number: Name of a timer or of a variable, or distance of the receiver from the sender in the circle of
            nodes.
        delay: For "schedule": ticks from now.
    """

    kind: Literal["broadcast", "unicast", "schedule", "cancel", "draw", "track"]
    number: int = 0
    delay: int = 0


Script = Sequence[Sequence[Action]]
"""Actions for one callback after the other; the script starts again after its last line."""


class Scripted(IProtocol):
    """Executes its script until its budget is used up. Each node starts at another line."""

    log: ClassVar[list[Entry]]
    script: ClassVar[Script]
    node_count: ClassVar[int]
    budget = 40  # actions; scripts may loop within one instant

    def initialize(self) -> None:
        self.callbacks = 0
        self.done = 0
        self.react("initialize", "")

    def handle_timer(self, timer: str) -> None:
        self.react("handle_timer", timer)

    def handle_packet(self, message: str) -> None:
        self.react("handle_packet", message)

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.react("handle_telemetry", str(telemetry.current_position))

    def finish(self) -> None:
        self.react("finish", "")

    def react(self, callback: str, argument: str) -> None:
        node = self.provider.get_id()
        self.log.append((self.provider.current_time(), node, callback, argument))
        line = self.script[(node + self.callbacks) % len(self.script)]
        self.callbacks += 1
        for action in line:
            if self.done == self.budget:
                return
            self.done += 1
            self.act(action, f"{node} sends its {self.done}. → {callback}")

    def act(self, action: Action, text: str) -> None:
        provider = self.provider
        match action.kind:
            case "broadcast":
                provider.send_communication_command(BroadcastMessageCommand(text))
            case "unicast" if self.node_count > 1:
                steps = 1 + action.number % (self.node_count - 1)
                destination = (provider.get_id() + steps) % self.node_count
                provider.send_communication_command(SendMessageCommand(text, destination))
            case "schedule":
                # One division, since the sum of two rounded times need not be the rounded sum.
                tick = round(provider.current_time() * TICKS_PER_S) + action.delay
                provider.schedule_timer(f"timer {action.number}", tick / TICKS_PER_S)
            case "cancel":
                provider.cancel_timer(f"timer {action.number}")
            case "draw":
                provider.tracked_variables["drawn"] = provider.random.random()
            case "track":
                provider.tracked_variables[f"variable {action.number}"] = self.callbacks


@dataclass(frozen=True)
class Outcome:
    """Observations on which both modes must agree.

    Attributes:
        log: All callbacks, in order.
        tracked: Variables of each node at the end.
        copies: {kind: (delivered, in the air at the end, out of range)}.
    """

    log: list[Entry]
    tracked: list[dict[str, Any]]
    copies: dict[str, tuple[int, int, int]]


def play(mode: str, case: Case, script: Script) -> Outcome:
    """Run the case in one mode with scripted protocols."""
    log: list[Entry] = []
    members = {"log": log, "script": script, "node_count": len(case.positions)}
    result = case.run(mode, type("Scripted", (Scripted,), members))
    outcomes = result.outcomes["frames"]
    return Outcome(
        log=log,
        tracked=[dict(node.tracked_variables) for node in result.nodes],
        copies={
            kind: (outcomes[kind]["delivered"], outcomes[kind]["in_air"], outcomes[kind]["below_sensitivity"])
            for kind in ("broadcast", "unicast")
        },
    )
