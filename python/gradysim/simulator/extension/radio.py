"""A radio with its own settings: it sends farther, later or less reliably than the others."""

from dataclasses import replace

from gradysim.encapsulator.python import PythonProvider
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.simulator.extension.extension import mode_of, provider_of
from gradysim.simulator.handler.communication import CommunicationHandler


class Radio:
    """Sends messages over a medium with its own settings; prototype mode only.

    It starts with the settings of the node's own radio. Messages to the node are not affected.
    """

    def __init__(self, protocol: IProtocol) -> None:
        """Attach another radio to the protocol's node.

        Raise ReferenceError if the protocol has no provider yet, as in its constructor. Raise TypeError if
        the node does not run in prototype mode, and RuntimeError if there is no communication handler.
        """
        provider = provider_of(protocol)
        if not isinstance(provider, PythonProvider):
            raise TypeError(
                f"Radio works in prototype mode only, and this node runs in {mode_of(provider)}: "
                "there the settings of radios belong to the scenario"
            )
        handler = provider.handlers.get("communication")
        if not isinstance(handler, CommunicationHandler):
            raise RuntimeError(f"Radio needs a CommunicationHandler in the simulation, found {handler!r}")
        self._node = provider.node
        self._handler = handler
        self._medium = replace(handler.medium_of.get(provider.node.id, handler.default_medium))

    def set_configuration(
        self,
        transmission_range: float | None = None,
        delay: float | None = None,
        failure_rate: float | None = None,
    ) -> None:
        """Change settings; None keeps a setting.

        Args:
            transmission_range: m, >= 0.
            delay: From sending to reception; s, >= 0.
            failure_rate: Probability that a receiver in range misses the message; 0 to 1.

        Raises:
            ValueError: A value is outside its range. Then nothing changes.
        """
        given = {"transmission_range": transmission_range, "delay": delay, "failure_rate": failure_rate}
        self._medium = replace(
            self._medium, **{name: value for name, value in given.items() if value is not None}
        )

    def send_communication_command(self, command: CommunicationCommand) -> None:
        """Send a message over the medium of this radio, like `IProvider.send_communication_command`."""
        self._handler.handle_command(command, self._node, self._medium)
