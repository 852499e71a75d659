"""Fixtures of the ZigZag example: its directory on the import path, and a provider that records."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.protocol.interface import IProtocol, IProvider
from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.protocol.messages.mobility import MobilityCommand

sys.path.insert(0, str(Path(__file__).parents[4] / "examples" / "zigzag"))


class FakeProvider(IProvider):
    """Records the commands of a protocol."""

    def __init__(self, node_id: int) -> None:
        self.node_id = node_id
        self.now = 0.0
        self.sent: list[CommunicationCommand] = []
        self.moves: list[MobilityCommand] = []
        self.timers: list[tuple[str, float]] = []
        self.tracked_variables: dict[str, Any] = {}

    def send_communication_command(self, command: CommunicationCommand) -> None:
        self.sent.append(command)

    def send_mobility_command(self, command: MobilityCommand) -> None:
        self.moves.append(command)

    def schedule_timer(self, timer: str, timestamp: float) -> None:
        self.timers.append((timer, timestamp))

    def cancel_timer(self, timer: str) -> None:
        self.timers = [pending for pending in self.timers if pending[0] != timer]

    def current_time(self) -> float:
        return self.now

    def get_id(self) -> int:
        return self.node_id


class Bench:
    """One protocol on a `FakeProvider`, for events of the test."""

    def __init__(self, protocol_class: type[IProtocol], node_id: int, parameters: dict[str, object]) -> None:
        self.provider = FakeProvider(node_id)
        configured: Any = type(protocol_class.__name__, (protocol_class,), parameters)
        self.protocol: IProtocol = configured.instantiate(self.provider)
        self.protocol.initialize()

    @property
    def tracked(self) -> dict[str, Any]:
        return self.provider.tracked_variables

    def next_timer(self) -> str:
        """Advance time to the next timer, fire it and return its name."""
        timer = min(self.provider.timers, key=lambda pending: pending[1])
        self.provider.timers.remove(timer)
        self.provider.now = timer[1]
        self.protocol.handle_timer(timer[0])
        return timer[0]

    def hear(self, *messages: Any) -> list[tuple[Any, int | None]]:
        """Receive the messages. Return what was sent since the last call, like `drain`."""
        from message import encode

        for message in messages:
            self.protocol.handle_packet(encode(message))
        return self.drain()

    def drain(self) -> list[tuple[Any, int | None]]:
        """Return what was sent since the last call: (message, destination), with None for a broadcast."""
        from message import decode

        sent = [(decode(command.message), command.destination) for command in self.provider.sent]
        self.provider.sent.clear()
        return sent


@pytest.fixture
def bench() -> Callable[..., Bench]:
    """`bench(protocol_class, node_id, **parameters)` starts a protocol."""

    def start(protocol_class: type[IProtocol], node_id: int, **parameters: object) -> Bench:
        return Bench(protocol_class, node_id, parameters)

    return start
