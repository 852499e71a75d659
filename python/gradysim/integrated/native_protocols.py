"""Native protocols on the nodes of the engine."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, cast

from gradysim.integrated.engine_errors import errors_at, settings_by_target
from gradysim.protocol.interface import IProvider
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.schema.native_protocols import NativeProtocol
from gradysim.scenario.schema.parameters import parametrize
from gradysim.scenario.schema.values import Setting

if TYPE_CHECKING:
    from gradysim import _netsim


def is_native(spec: NodeSpec) -> bool:
    """Return whether the node's protocol is one of the engine's."""
    return issubclass(spec.protocol, NativeProtocol)


def set_native_protocol(node: "_netsim.Node", spec: NodeSpec) -> None:
    """Give `node` the native protocol of `spec`, after all nodes have been created.

    Raises ConfigError, with the source in the .ini file, if a parameter is outside its range, or is not valid
    for this node in this network.
    """
    values = cast("Mapping[str, bool | int | float]", spec.protocol_parameters)
    settings = {
        f"protocol.{name}": Setting(values.get(name, ""), source)
        for name, source in spec.protocol_sources.items()  # under "": the line that chose the protocol
    }
    with errors_at({**settings_by_target("mobility", spec.mobility), **settings}):
        node.set_native_protocol(spec.protocol.__name__, values)
        node.check_protocol()


class NativeView:
    """A node's native protocol as handlers see it, instead of an encapsulator.

    Attributes:
        provider: Gives the tracked variables, the id and the time.
        protocol: An instance of the class in the scenario: it has the parameters, and its callbacks do
            nothing.
    """

    def __init__(self, node: "_netsim.Node", spec: NodeSpec) -> None:
        self.provider = NativeProvider(node)
        cls = parametrize(spec.protocol, spec.protocol_parameters)
        self.protocol = cls.instantiate(cast(IProvider, self.provider))


class NativeProvider:
    """Provider of a native protocol, for handlers."""

    def __init__(self, node: "_netsim.Node") -> None:
        self._node = node

    @property
    def tracked_variables(self) -> dict[str, Any]:
        """The current tracked variables."""
        return dict(self._node.tracked_variables)

    def current_time(self) -> float:
        """Return the simulated time in seconds."""
        return self._node.current_time()

    def get_id(self) -> int:
        """Return the id of the node."""
        return self._node.id
