"""Native protocols: the engine's table of them for the reader of .ini files, and their place on a node."""

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, cast

from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.engine_errors import errors_at, settings_by_target
from gradysim.protocol.interface import IProvider
from gradysim.scenario.node.node_spec import NodeSpec
from gradysim.scenario.protocol.native import NativeParameter, NativeProtocol
from gradysim.scenario.protocol.parametrize import parametrize
from gradysim.scenario.settings import Setting

if TYPE_CHECKING:
    from gradysim import _netsim


@cache
def native_protocols() -> dict[str, type[NativeProtocol]]:
    """Return the engine's protocols by name. Raises CompiledPartMissingError when it has not been built."""
    return {row.name: _class_of(row) for row in load_netsim().native_protocols()}


def is_native(spec: NodeSpec) -> bool:
    """Whether the engine has the node's protocol itself."""
    return issubclass(spec.protocol, NativeProtocol)


def set_native_protocol(node: "_netsim.Node", spec: NodeSpec) -> None:
    """Give `node` the native protocol of `spec`, when all nodes are there.

    Raises ConfigError, with the place in the .ini file, when a parameter is outside its range, or is one that
    this node cannot have in this network.
    """
    values = cast("Mapping[str, bool | int | float]", spec.protocol_parameters)
    settings = {
        f"protocol.{name}": Setting(values.get(name, ""), source)
        for name, source in spec.protocol_sources.items()  # under "" what chose the protocol
    }
    with errors_at({**settings_by_target("mobility", spec.mobility), **settings}):
        node.set_native_protocol(spec.protocol.__name__, values)
        node.check_protocol()


class NativeView:
    """What handlers see of a node with a native protocol, where others have an encapsulator.

    Attributes:
        provider: Knows the tracked variables, the id and the time.
        protocol: An instance of the class in the scenario: it shows the parameters, and does nothing.
    """

    def __init__(self, node: "_netsim.Node", spec: NodeSpec) -> None:
        self.provider = NativeProvider(node)
        cls = parametrize(spec.protocol, spec.protocol_parameters)
        self.protocol = cls.instantiate(cast(IProvider, self.provider))


class NativeProvider:
    """What can be asked of the node of a native protocol from outside."""

    def __init__(self, node: "_netsim.Node") -> None:
        self._node = node

    @property
    def tracked_variables(self) -> dict[str, Any]:
        """What the protocol tracks now."""
        return dict(self._node.tracked_variables)

    def current_time(self) -> float:
        """Return the simulated time in seconds."""
        return self._node.current_time()

    def get_id(self) -> int:
        """Return the id of the node."""
        return self._node.id


def _class_of(row: "_netsim.NativeProtocol") -> type[NativeProtocol]:
    parameters = {
        parameter.name: NativeParameter(parameter.unit, parameter.meaning) for parameter in row.parameters
    }
    return type(
        row.name,
        (NativeProtocol,),
        {
            "__module__": __name__,
            "__doc__": row.meaning,
            "_meaning": row.meaning,
            "_python_class": row.python_class,
            "_parameters": parameters,
            **{parameter.name: parameter.default for parameter in row.parameters},
        },
    )
