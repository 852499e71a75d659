"""A Raft node's environment made of what a protocol's provider offers."""

from random import Random

from gradysim.protocol.interface import IProvider
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand

RAFT_DISPATCH_PREFIX = "__RAFT__"
"""Marks what is the consensus's."""

PREFIX = f"{RAFT_DISPATCH_PREFIX}:"
"""Begins every message and every timer of the consensus; the rest is not the protocol's."""

REQUIRED_METHODS = (
    "send_communication_command",
    "schedule_timer",
    "cancel_timer",
    "current_time",
    "get_id",
)


class ProviderEnvironment:
    """Puts the prefix in front of messages and timers, and passes them on."""

    def __init__(self, provider: IProvider) -> None:
        self._provider = provider
        self._node_id = provider.get_id()
        # A provider need not be an IProvider, and then may have no stream of its own.
        stream: Random | None = getattr(provider, "random", None)
        self._random = Random(self._node_id) if stream is None else stream

    @property
    def node_id(self) -> int:
        """Id of the node."""
        return self._node_id

    @property
    def random(self) -> Random:
        """The node's stream of random numbers."""
        return self._random

    def now_s(self) -> float:
        """Time in seconds."""
        return self._provider.current_time()

    def send(self, message: str, destination: int | None) -> None:
        """Send to one node, or to everybody in reach if `destination` is None."""
        text = PREFIX + message
        self._provider.send_communication_command(
            BroadcastMessageCommand(text) if destination is None else SendMessageCommand(text, destination)
        )

    def set_timer(self, name: str, delay_s: float) -> None:
        """Schedule a timer `delay_s` seconds from now."""
        self._provider.schedule_timer(PREFIX + name, self._provider.current_time() + delay_s)

    def cancel_timer(self, name: str) -> None:
        """Forget all pending timers of that name."""
        self._provider.cancel_timer(PREFIX + name)
