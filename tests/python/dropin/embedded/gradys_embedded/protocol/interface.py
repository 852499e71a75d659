from abc import ABC, abstractmethod
from typing import Any

from gradys_embedded.protocol.messages.communication import CommunicationCommand
from gradys_embedded.protocol.messages.mobility import MobilityCommand
from gradys_embedded.protocol.messages.telemetry import Telemetry


class IProvider(ABC):
    tracked_variables: dict[str, Any]

    @abstractmethod
    def send_communication_command(self, command: CommunicationCommand) -> None: ...

    @abstractmethod
    def send_mobility_command(self, command: MobilityCommand) -> None: ...

    @abstractmethod
    def schedule_timer(self, timer: str, timestamp: float) -> None: ...

    @abstractmethod
    def cancel_timer(self, timer: str) -> None: ...

    @abstractmethod
    def current_time(self) -> float: ...

    @abstractmethod
    def get_id(self) -> int: ...


class IProtocol(ABC):
    provider: IProvider

    @classmethod
    def instantiate(cls, provider: IProvider) -> "IProtocol":
        made = cls()
        made.provider = provider
        return made

    @abstractmethod
    def initialize(self) -> None: ...

    @abstractmethod
    def handle_timer(self, timer: str) -> None: ...

    @abstractmethod
    def handle_packet(self, message: str) -> None: ...

    @abstractmethod
    def handle_telemetry(self, telemetry: Telemetry) -> None: ...

    @abstractmethod
    def finish(self) -> None: ...
