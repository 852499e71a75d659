"""Checks of a simulation while it runs: what must always be true, and what must be so at least once.

A decorator turns a predicate into a case, and an `AssertionHandler` evaluates its cases after each event:

    @assert_always_true_for_protocol(Drone, "below the ceiling")
    def below_the_ceiling(node: Node[Drone]) -> bool:
        return node.position[2] <= 100

    builder.add_handler(AssertionHandler([below_the_ceiling]))
"""

import sys
from abc import ABC
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.plain_value import readable_number
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.log import label_node
from gradysim.simulator.node import Node

_P = TypeVar("_P", bound=IProtocol)

_NodePredicate = Callable[[Node[_P]], bool]
_SimulationPredicate = Callable[[list[Node[Any]]], bool]


class FailedAssertionException(Exception):  # noqa: N818 (the published name)
    """Something that must be true was not; the text says what, for which node and when."""


class SimulationTestCase(ABC):  # noqa: B024 (both methods are optional)
    """A check of one simulation; a new instance is made for each.

    Attributes:
        asked: Class of the protocols whose nodes are checked; None for all nodes.
    """

    asked: ClassVar[type[IProtocol] | None] = None

    def test_iteration(self, nodes: list[Node[Any]], iteration: int, timestamp: float) -> None:
        """Called after each event.

        Args:
            nodes: All nodes, in the order of their making.
            iteration: Number of the event, from 0 on.
            timestamp: Simulated time in seconds.

        Raises:
            FailedAssertionException: The check failed.
        """
        return

    def finalize(self) -> None:
        """Called after the last event, and after the protocols' `finish`; raises as `test_iteration`."""
        return


def assert_always_true_for_protocol(
    protocol_type: type[_P], name: str, description: str = ""
) -> Callable[[_NodePredicate[_P]], type[SimulationTestCase]]:
    """Demand that the predicate is true of every node of a protocol after every event.

    Args:
        protocol_type: Nodes with a protocol of this class, or a subclass, are checked.
        name: Of the check, for the message of its failure.
        description: More words for that message.
    """
    _check_class(protocol_type)

    def decorate(predicate: _NodePredicate[_P]) -> type[SimulationTestCase]:
        class Case(SimulationTestCase):
            asked = protocol_type

            def test_iteration(self, nodes: list[Node[Any]], iteration: int, timestamp: float) -> None:
                for node in _of_type(nodes, protocol_type):
                    if not predicate(node):
                        raise _failure(name, description, _when(iteration, timestamp), node)

        return _named(Case, predicate)

    return decorate


def assert_eventually_true_for_protocol(
    protocol_type: type[_P], name: str, description: str = ""
) -> Callable[[_NodePredicate[_P]], type[SimulationTestCase]]:
    """Demand that the predicate is true of each node of a protocol after at least one event.

    The arguments are those of `assert_always_true_for_protocol`. Without such nodes, or any event, there
    is nothing to fail.
    """
    _check_class(protocol_type)

    def decorate(predicate: _NodePredicate[_P]) -> type[SimulationTestCase]:
        class Case(SimulationTestCase):
            asked = protocol_type

            def __init__(self) -> None:
                self._waiting: list[Node[Any]] | None = None

            def test_iteration(self, nodes: list[Node[Any]], iteration: int, timestamp: float) -> None:
                if self._waiting is None:
                    self._waiting = _of_type(nodes, protocol_type)
                if self._waiting:
                    self._waiting = [node for node in self._waiting if not predicate(node)]

            def finalize(self) -> None:
                if self._waiting:
                    raise _failure(name, description, _NEVER, *self._waiting)

        return _named(Case, predicate)

    return decorate


def assert_always_true_for_simulation(
    name: str, description: str = ""
) -> Callable[[_SimulationPredicate], type[SimulationTestCase]]:
    """Demand that the predicate is true of the list of all nodes after every event.

    Args:
        name: Of the check, for the message of its failure.
        description: More words for that message.
    """

    def decorate(predicate: _SimulationPredicate) -> type[SimulationTestCase]:
        class Case(SimulationTestCase):
            def test_iteration(self, nodes: list[Node[Any]], iteration: int, timestamp: float) -> None:
                if not predicate(nodes):
                    raise _failure(name, description, _when(iteration, timestamp))

        return _named(Case, predicate)

    return decorate


def assert_eventually_true_for_simulation(
    name: str, description: str = ""
) -> Callable[[_SimulationPredicate], type[SimulationTestCase]]:
    """Demand that the predicate is true of the list of all nodes after at least one event.

    The arguments are those of `assert_always_true_for_simulation`. Without any event it was never true.
    """

    def decorate(predicate: _SimulationPredicate) -> type[SimulationTestCase]:
        class Case(SimulationTestCase):
            def __init__(self) -> None:
                self._met = False

            def test_iteration(self, nodes: list[Node[Any]], iteration: int, timestamp: float) -> None:
                self._met = self._met or bool(predicate(nodes))

            def finalize(self) -> None:
                if not self._met:
                    raise _failure(name, description, _NEVER)

        return _named(Case, predicate)

    return decorate


class AssertionHandler(INodeHandler):
    """Evaluates cases after each event. The first that fails ends the simulation with its exception."""

    def __init__(self, assertions: Sequence[type[SimulationTestCase]]) -> None:
        """Take the cases, which are classes.

        Raises:
            TypeError: One of them is something else, such as a predicate without its decorator, or they are
                no list.
        """
        if not isinstance(assertions, Iterable):
            raise TypeError(f"expected a list of cases, got {assertions!r}")
        for case in assertions:
            if not (isinstance(case, type) and issubclass(case, SimulationTestCase)):
                raise TypeError(
                    "expected subclasses of SimulationTestCase, as the assert_* decorators make them, "
                    f"got {case!r}"
                )
        self._assertions = tuple(assertions)
        self._cases: list[SimulationTestCase] = []
        self._nodes: list[Node[Any]] = []

    @staticmethod
    def get_label() -> str:
        """Return "assertion"."""
        return "assertion"

    def inject(self, event_loop: EventLoop) -> None:
        """Reset for a new simulation."""
        self._nodes = []
        self._cases = [case() for case in self._assertions]

    def register_node(self, node: Node[Any]) -> None:
        """Take one more node to check."""
        self._nodes.append(node)

    def initialize(self) -> None:
        """See that the cases find their nodes.

        Raises:
            TypeError: The file of a node's protocol was loaded twice, and a case asks for the other class.
        """
        for case in self._cases:
            if case.asked is not None:
                for node in self._nodes:
                    _check_not_loaded_twice(node, case.asked)

    def after_simulation_step(self, iteration: int, timestamp: float) -> None:
        """Evaluate all cases.

        Raises:
            FailedAssertionException: One of them failed. What a predicate raises goes through, with a note.
        """
        name = ""
        try:
            for case in self._cases:
                name = type(case).__name__
                case.test_iteration(self._nodes, iteration, timestamp)
        except BaseException as error:
            self.stop_judging()
            if not isinstance(error, FailedAssertionException | KeyboardInterrupt):
                error.add_note(f"in the assertion {name}: {_when(iteration, timestamp)}")
            raise

    def stop_judging(self) -> None:
        """Drop the cases, since the simulation ends early."""
        self._cases = []

    def finalize(self) -> None:
        """Give each case its last word.

        Raises:
            FailedAssertionException: One of them failed.
        """
        cases, self._cases = self._cases, []
        for case in cases:
            case.finalize()


_NEVER = "the condition was never met during the simulation"


def _of_type(nodes: list[Node[Any]], protocol_type: type[IProtocol]) -> list[Node[Any]]:
    return [node for node in nodes if isinstance(node.protocol_encapsulator.protocol, protocol_type)]


def _check_class(protocol_type: object) -> None:
    """The name of a class, or an instance, would be found out after the first event only."""
    if not isinstance(protocol_type, type):
        raise TypeError(f"expected a protocol's class, got {protocol_type!r}")


def _check_not_loaded_twice(node: Node[Any], asked: type[IProtocol]) -> None:
    """The same source may be two classes, and what is asked of one would silently not be of the other."""
    protocol = type(getattr(node.protocol_encapsulator, "protocol", None))
    if issubclass(protocol, asked):
        return
    file = _file_of(asked)
    for other in protocol.__mro__:
        if file is not None and other.__qualname__ == asked.__qualname__ and _file_of(other) == file:
            raise TypeError(
                f"an assertion asks for nodes with {asked.__module__}.{asked.__qualname__}, but node "
                f"{node.id} runs {other.__module__}.{other.__qualname__}, another class from the same "
                f"file, {file}, which was loaded twice. Import the protocol from a module of its own, and "
                f'let a scenario name it as that does: "{file.stem}:{asked.__qualname__}", '
                f'not "{file.name}:..."'
            )


def _file_of(cls: type) -> Path | None:
    name = getattr(sys.modules.get(cls.__module__), "__file__", None)
    return None if name is None else Path(name).resolve()


def _named(case: type[SimulationTestCase], predicate: Callable[..., bool]) -> type[SimulationTestCase]:
    """Let the case go by the name of its predicate."""
    case.__name__ = getattr(predicate, "__name__", case.__name__)
    case.__qualname__ = getattr(predicate, "__qualname__", case.__name__)
    case.__module__ = predicate.__module__
    case.__doc__ = predicate.__doc__
    return case


def _when(iteration: int, timestamp: float) -> str:
    return f"[iteration={iteration} | timestamp={readable_number(timestamp)}]"


def _failure(name: str, description: str, when: str, *nodes: Node[Any]) -> FailedAssertionException:
    about = f" ({description})" if description else ""
    at = f" for node {', '.join(f'{node.id} ({label_node(node)})' for node in nodes)}" if nodes else ""
    return FailedAssertionException(f'Assertion "{name}"{about} failed{at}: {when}')
