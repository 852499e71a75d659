from dataclasses import dataclass
from enum import Enum


class CommunicationCommandType(int, Enum):
    SEND = 0
    BROADCAST = 1


@dataclass
class CommunicationCommand:
    command_type: CommunicationCommandType
    message: str
    destination: int | None = None


class SendMessageCommand(CommunicationCommand):
    def __init__(self, message: str, destination: int) -> None:
        super().__init__(CommunicationCommandType.SEND, message, destination)


class BroadcastMessageCommand(CommunicationCommand):
    def __init__(self, message: str) -> None:
        super().__init__(CommunicationCommandType.BROADCAST, message)
