"""Commands with which a protocol sends a message to other nodes."""

from dataclasses import dataclass, field
from enum import Enum


class CommunicationCommandType(int, Enum):
    """Addressing of a message.

    Attributes:
        SEND: To the node `CommunicationCommand.destination`.
        BROADCAST: To every node in range.
    """

    SEND = 0
    BROADCAST = 1


@dataclass
class CommunicationCommand:
    """Sends `message`. Messages may be lost: see `IProtocol.handle_failed_message`.

    Attributes:
        command_type: Addressing of the message.
        message: Any str. Its airtime depends on its length in UTF-8.
        destination: Id or name of the receiving node; only for `SEND`. See `IProvider.id_of` for names.
        interface: Index of the node's network interface that sends it, 0 to 15: 1 for wlan[1]. Prototype mode
            has one medium, which all interfaces share.
    """

    command_type: CommunicationCommandType
    message: str
    destination: int | str | None = None
    interface: int = field(default=0, kw_only=True)


class SendMessageCommand(CommunicationCommand):
    """Sends `message` to the node with the id or the name `destination` alone."""

    def __init__(self, message: str, destination: int | str, *, interface: int = 0) -> None:
        super().__init__(CommunicationCommandType.SEND, message, destination, interface=interface)


class BroadcastMessageCommand(CommunicationCommand):
    """Sends `message` to every node in range."""

    def __init__(self, message: str, *, interface: int = 0) -> None:
        super().__init__(CommunicationCommandType.BROADCAST, message, interface=interface)
