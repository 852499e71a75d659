"""Assertions evaluated during a run: conditions that hold always, or at least once.

A decorator turns a predicate into a test case. An `AssertionHandler` evaluates its cases after each event::

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
    """An assertion failed. The message names the assertion, the node and the time."""


class SimulationTestCase(ABC):  # noqa: B024 (both methods are optional)
    """An assertion about one simulation; each simulation gets a new instance.

    Attributes:
        asked: Class of the protocols whose nodes are checked; None for all nodes.
    """

    asked: ClassVar[type[IProtocol] | None] = None

    def test_iteration(self, nodes: list[Node[Any]], iteration: int, timestamp: float) -> None:
        """Called after event number `iteration`, from 0 on, at `timestamp` (s), with all nodes by id.

        Raise FailedAssertionException if the check failed.
        """
        return

    def finalize(self) -> None:
        """Called after the last event and the protocols' `finish`; raises like `test_iteration`."""
        return


def assert_always_true_for_protocol(
    protocol_type: type[_P], name: str, description: str = ""
) -> Callable[[_NodePredicate[_P]], type[SimulationTestCase]]:
    """Assert that the predicate is true of every node of a protocol after every event.

    Args:
        protocol_type: Nodes with a protocol of this class, or a subclass, are checked.
        name: Name of the assertion, for the message of its failure.
        description: Further text for that message.
    """
    return _decorator(_Always, name, description, _checked_class(protocol_type))


def assert_eventually_true_for_protocol(
    protocol_type: type[_P], name: str, description: str = ""
) -> Callable[[_NodePredicate[_P]], type[SimulationTestCase]]:
    """Assert that the predicate is true of each node of a protocol after at least one event.

    The arguments are those of `assert_always_true_for_protocol`. The assertion holds if there are no such
    nodes, or no events.
    """
    return _decorator(_Eventually, name, description, _checked_class(protocol_type))


def assert_always_true_for_simulation(
    name: str, description: str = ""
) -> Callable[[_SimulationPredicate], type[SimulationTestCase]]:
    """Assert that the predicate is true of the list of all nodes after every event.

    The arguments are those of `assert_always_true_for_protocol`.
    """
    return _decorator(_Always, name, description)


def assert_eventually_true_for_simulation(
    name: str, description: str = ""
) -> Callable[[_SimulationPredicate], type[SimulationTestCase]]:
    """Assert that the predicate is true of the list of all nodes after at least one event.

    The arguments are those of `assert_always_true_for_protocol`. Without events the assertion fails.
    """
    return _decorator(_Eventually, name, description)


_NAMES = ("__qualname__", "__module__", "__doc__")


def _decorator(
    base: "type[_PredicateCase]", name: str, description: str, asked: type[IProtocol] | None = None
) -> Callable[[Callable[..., bool]], type[SimulationTestCase]]:
    title = f'Assertion "{name}"' + (f" ({description})" if description else "")

    def decorate(predicate: Callable[..., bool]) -> type[SimulationTestCase]:
        attributes = {"predicate": staticmethod(predicate), "title": title, "asked": asked}
        named = {key: getattr(predicate, key) for key in _NAMES if hasattr(predicate, key)}
        return type(getattr(predicate, "__name__", base.__name__), (base,), {**named, **attributes})

    return decorate


class _PredicateCase(SimulationTestCase):
    predicate: Callable[[Any], bool]
    title: str

    def _subjects(self, nodes: list[Node[Any]]) -> list[Any]:
        """Arguments of the predicate: each node of the protocol, or the list of all nodes."""
        if self.asked is None:
            return [nodes]
        return [node for node in nodes if isinstance(node.protocol_encapsulator.protocol, self.asked)]

    def _failure(self, when: str, subjects: list[Any]) -> FailedAssertionException:
        named = [] if self.asked is None else [f"{node.id} ({label_node(node)})" for node in subjects]
        at = f" for node {', '.join(named)}" if named else ""
        return FailedAssertionException(f"{self.title} failed{at}: {when}")


class _Always(_PredicateCase):
    def test_iteration(self, nodes: list[Node[Any]], iteration: int, timestamp: float) -> None:
        for subject in self._subjects(nodes):
            if not self.predicate(subject):
                raise self._failure(_when(iteration, timestamp), [subject])


class _Eventually(_PredicateCase):
    _waiting: list[Any] | None = None

    def test_iteration(self, nodes: list[Node[Any]], iteration: int, timestamp: float) -> None:
        waiting = self._subjects(nodes) if self._waiting is None else self._waiting
        self._waiting = [subject for subject in waiting if not self.predicate(subject)]

    def finalize(self) -> None:
        if self._waiting or (self._waiting is None and self.asked is None):
            raise self._failure("the condition was never met during the simulation", self._waiting or [])


class AssertionHandler(INodeHandler):
    """Evaluates assertions after each event.

    The first one that fails ends the simulation with its exception.
    """

    def __init__(self, assertions: Sequence[type[SimulationTestCase]]) -> None:
        """Take the assertions, which are classes.

        Raise TypeError if they are not a list of such classes; for example, if a decorator is missing.
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
        """Add a node to check."""
        self._nodes.append(node)

    def initialize(self) -> None:
        """Check that the assertions find their nodes.

        Raise TypeError if the file of a node's protocol was loaded twice, and an assertion names the other
        class.
        """
        for case in self._cases:
            if case.asked is not None:
                for node in self._nodes:
                    _check_not_loaded_twice(node, case.asked)

    def after_simulation_step(self, iteration: int, timestamp: float) -> None:
        """Evaluate all assertions. FailedAssertionException if one fails.

        Exceptions of a predicate get a note.
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
        """Drop the assertions, since the simulation ends early."""
        self._cases = []

    def finalize(self) -> None:
        """Finalize each assertion. FailedAssertionException if one fails."""
        cases, self._cases = self._cases, []
        for case in cases:
            case.finalize()


def _checked_class(protocol_type: type[_P]) -> type[_P]:
    """Return the class. Raise TypeError here, since an instance or a name would fail only after an event."""
    if not isinstance(protocol_type, type):
        raise TypeError(f"expected a protocol's class, got {protocol_type!r}")
    return protocol_type


def _check_not_loaded_twice(node: Node[Any], asked: type[IProtocol]) -> None:
    """Two classes may come from the same source. An assertion about one would silently skip the other."""
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


def _when(iteration: int, timestamp: float) -> str:
    return f"[iteration={iteration} | timestamp={readable_number(timestamp)}]"
