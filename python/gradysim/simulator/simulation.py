"""Builds a simulation from nodes and handlers: the entry point of scripts for prototype mode."""

import random
from collections.abc import Callable
from typing import Any

from gradysim.protocol.checked_values import checked_point, checked_range
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.position import Position
from gradysim.simulator.configuration import SimulationConfiguration
from gradysim.simulator.event import EventLoop as EventLoop  # 0.8 exports it, and Node, from here
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.registry import label_of
from gradysim.simulator.node import Node as Node
from gradysim.simulator.real_time import full_speed
from gradysim.simulator.simulator import Simulator
from gradysim.simulator.validation import checked_configuration, checked_protocol_class


class PositionScheme:
    """Functions that return the initial position of a node."""

    @staticmethod
    def random(
        x_range: tuple[float, float] = (-10, 10),
        y_range: tuple[float, float] = (-10, 10),
        z_range: tuple[float, float] = (0, 10),
    ) -> Position:
        """Draw a point of a box (m) uniformly, from Python's global random stream.

        Raise ValueError if a range is not (low, high) of finite numbers, low <= high.
        """
        box = [
            checked_range(f"{axis}_range", given, ValueError)
            for axis, given in zip("xyz", (x_range, y_range, z_range), strict=True)
        ]
        x, y, z = (random.uniform(lowest, highest) for lowest, highest in box)
        return (x, y, z)


__all__ = ["PositionScheme", "SimulationBuilder", "SimulationConfiguration", "Simulator"]

_ForceFastExecution = full_speed  # the published name


class SimulationBuilder:
    """Collects handlers and nodes.

    `build` may be called again after the end of the simulation before. Both use the same handlers, which
    serve one simulation at a time.
    """

    def __init__(self, configuration: SimulationConfiguration | None = None) -> None:
        """Without a configuration the defaults of `SimulationConfiguration` hold."""
        self._configuration = checked_configuration(configuration, SimulationConfiguration)
        self._handlers: dict[str, INodeHandler] = {}
        self._nodes: list[tuple[type[IProtocol], Position]] = []
        self._ids_by_name: dict[str, int] = {}
        self._prepare_node: Callable[[Node[Any]], None] | None = None

    def prepare_nodes(self, prepare_node: Callable[[Node[Any]], None]) -> "SimulationBuilder":
        """Call `Simulator.prepare_node` with each new node. Return the builder."""
        self._prepare_node = prepare_node
        return self

    def add_handler(self, handler: INodeHandler) -> "SimulationBuilder":
        """Add a handler. It replaces one with the same label. Return the builder."""
        self._handlers[label_of(handler)] = handler
        return self

    def add_node(self, protocol: type[IProtocol], position: Position, name: str = "") -> int:
        """Add a node at (x, y, z) in meters with a protocol of this class. Return its id: 0, then 1, ...

        Protocols can send to it by its `name`, such as `SendMessageCommand(text, "base")`. Raises ValueError
        if another node has the name, and TypeError if it is not a str.
        """
        if not isinstance(name, str):
            raise TypeError(f"the name of a node must be a str, got {name!r}")
        if name in self._ids_by_name:
            raise ValueError(f"there is a node with the name {name!r} already")
        checked = checked_point("the position of a node", position, ValueError)
        self._nodes.append((checked_protocol_class(protocol), checked))
        identifier = len(self._nodes) - 1
        if name:
            self._ids_by_name[name] = identifier
        return identifier

    def build(self) -> Simulator:
        """Make the simulation: inject the event loop into the handlers, then create the nodes in order."""
        simulator = Simulator(self._handlers, self._configuration)
        simulator.prepare_node = self._prepare_node
        simulator.ids_by_name = dict(self._ids_by_name)
        for identifier, (protocol, position) in enumerate(self._nodes):
            simulator.create_node(position, protocol, identifier)
        return simulator
