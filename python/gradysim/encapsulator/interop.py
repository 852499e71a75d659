"""Encapsulator for another program that hosts the protocol and carries out its commands.

The host sets time and id, calls a callback and gets the list of consequences, in order.
"""

from collections.abc import Callable
from copy import copy
from enum import Enum
from random import Random
from typing import Any

from gradysim.encapsulator.interface import IEncapsulator
from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.encapsulator.tracked_variables import TrackedVariables
from gradysim.protocol.errors import add_protocol_note
from gradysim.protocol.interface import IProtocol, IProvider
from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.protocol.messages.mobility import MobilityCommand


class ConsequenceType(int, Enum):
    """Kind of a consequence, which decides the type of its payload.

    Attributes:
        COMMUNICATION: Payload: CommunicationCommand.
        MOBILITY: Payload: MobilityCommand.
        TIMER: Payload: (name, absolute time in seconds).
        TRACK_VARIABLE: Payload: (name, value); the value of a removed variable is None.
        CANCEL_TIMER: Payload: name of the timers to cancel.
    """

    COMMUNICATION = 0
    MOBILITY = 1
    TIMER = 2
    TRACK_VARIABLE = 3
    CANCEL_TIMER = 4


Payload = CommunicationCommand | MobilityCommand | tuple[str, float] | tuple[str, Any] | str
Consequence = tuple[ConsequenceType, Payload]


class InteropProvider(IProvider):
    """Provider that collects what the protocol does.

    Attributes:
        consequences: Consequences since the host last took them.
        timestamp: Simulated time in seconds, set by the host.
        id: Id of the node, set by the host.
        seed: Seed of the run, set by the host.
    """

    def __init__(self) -> None:
        self.consequences: list[Consequence] = []
        self.timestamp: float = 0
        self.id = 0
        self.seed = 0
        self._random: Random | None = None
        self._tracked_variables = TrackedVariables(
            lambda *change: self.consequences.append((ConsequenceType.TRACK_VARIABLE, change))
        )

    @property
    def tracked_variables(self) -> dict[str, Any]:
        """The tracked variables; each change is a consequence."""
        return self._tracked_variables

    @tracked_variables.setter
    def tracked_variables(self, variables: dict[str, Any]) -> None:
        self._tracked_variables.replace(variables)

    def send_communication_command(self, command: CommunicationCommand) -> None:
        """Collect the command as it is now."""
        self.consequences.append((ConsequenceType.COMMUNICATION, copy(command)))

    def send_mobility_command(self, command: MobilityCommand) -> None:
        """Collect the command as it is now."""
        self.consequences.append((ConsequenceType.MOBILITY, copy(command)))

    def schedule_timer(self, timer: str, timestamp: float) -> None:
        """Collect the timer. The host checks its time."""
        self.consequences.append((ConsequenceType.TIMER, (timer, timestamp)))

    def cancel_timer(self, timer: str) -> None:
        """Collect the cancellation."""
        self.consequences.append((ConsequenceType.CANCEL_TIMER, timer))

    def current_time(self) -> float:
        """Return the time that the host set, seconds."""
        return self.timestamp

    def get_id(self) -> int:
        """Return the id that the host set."""
        return self.id

    @property
    def random(self) -> Random:
        """The node's random stream. It is made on first use, from the current seed and id."""
        if self._random is None:
            self._random = RandomStream(self.seed, self.id, Purpose.PROTOCOL)
        return self._random


def _collecting(callback: str) -> Callable[..., list[Consequence]]:
    """Return the method that runs a callback of the protocol and takes its consequences."""

    def run(self: "InteropEncapsulator", *arguments: Any) -> list[Consequence]:
        provider = self.provider
        try:
            getattr(self.protocol, callback)(*arguments)
        except BaseException as exception:
            provider.consequences = []
            add_protocol_note(
                exception,
                node_id=provider.id,
                protocol=type(self.protocol),
                time_s=provider.timestamp,
                callback=callback,
            )
            raise
        consequences, provider.consequences = provider.consequences, []
        return consequences

    return run


class InteropEncapsulator(IEncapsulator[IProtocol]):
    """Calls the protocol; each callback returns its consequences, in order.

    An exception of the protocol gets a note with node, time and callback. The consequences of that callback
    are dropped.
    """

    provider: InteropProvider

    def __init__(self) -> None:
        self.provider = InteropProvider()

    def encapsulate(self, protocol: type[IProtocol]) -> None:
        """Make an instance of the protocol."""
        self.protocol = protocol.instantiate(self.provider)

    def set_timestamp(self, timestamp: float) -> None:
        """Set the simulated time in seconds, before each callback."""
        self.provider.timestamp = timestamp

    def set_id(self, id: int) -> None:
        """Set the id of the node, before `initialize`."""
        self.provider.id = id

    def set_seed(self, seed: int) -> None:
        """Set the seed of the run, before `initialize`; the default is 0."""
        self.provider.seed = seed

    initialize = _collecting("initialize")
    handle_timer = _collecting("handle_timer")
    handle_packet = _collecting("handle_packet")
    handle_telemetry = _collecting("handle_telemetry")
    finish = _collecting("finish")
