"""Log of a run: each callback of its protocols, what it did, and what caused it.

A replay has frames and timers, but not what a callback changed, nor which message is in which frame. The
first difference between two runs needs both.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from heapq import heappop, heappush
from typing import Any, Final, Literal, NamedTuple, TypeAlias

from gradysim.execution.scenario_run import ScenarioRun
from gradysim.integrated.native_protocols import is_native
from gradysim.protocol.interface import CALLBACKS, FAILED_MESSAGE_CALLBACK, IProtocol, IProvider
from gradysim.protocol.messages.communication import CommunicationCommand, CommunicationCommandType
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.plain_value import as_float
from gradysim.protocol.position import Position
from gradysim.replay.tables import BROADCAST
from gradysim.scenario.scenario import Scenario

Action = Literal["send", "timer", "cancel", "move", "set", "attribute", "raise"]

_NUMBER = re.compile(r"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
_KEPT = 200
"""Characters of a message that are kept and compared."""

_NS_PER_S = 1e9
_PLAIN = frozenset({str, bool, int, float, type(None)})
_CONTAINERS = frozenset({list, tuple, dict, set, frozenset})
_State: TypeAlias = tuple[dict[str, object], dict[str, object]]
"""Tracked variables, and attributes of the protocol."""

_LOGGED: Final = (*(name for name in CALLBACKS if name != "finish"), FAILED_MESSAGE_CALLBACK)


def without_numbers(text: str) -> str:
    """Return `retry-#` for `retry-17`: names that differ in numbers alone count as one."""
    return _NUMBER.sub("#", text)


class Effect(NamedTuple):
    """One thing that a callback did.

    Attributes:
        action: `send` a message, set or `cancel` a `timer`, `move` the vehicle, `set` a tracked variable,
            change an `attribute` of the protocol, `raise` an exception.
        what: The destination, or the name of the timer, variable, attribute or exception.
        value: The start of the message, the new value, or the first line of the exception.
    """

    action: Action
    what: str | int
    value: object

    @property
    def alike(self) -> tuple[object, ...]:
        """What is equal in two runs that do the same with other numbers."""
        value = without_numbers(self.value) if isinstance(self.value, str) else ""
        if isinstance(self.value, bool | None):
            value = str(self.value)
        return self.action, without_numbers(self.what) if isinstance(self.what, str) else self.what, value


class Cause(NamedTuple):
    """Where a callback comes from: the timer or message number `number` of its kind that another one made.

    Attributes:
        callback: Its index in the log; ~ID for messages of a node with a native protocol.
        kind: `timer NAME` without numbers, or the destination of a message. Native: what sent the message.
        number: 0 for the first one of this kind in that callback; native: of the run.
    """

    callback: int
    kind: str | int
    number: int


@dataclass(slots=True)
class Callback:
    """A call of a protocol's method.

    Attributes:
        node: Id of the node.
        time_ns: Simulated time.
        name: As replays have it: `initialize`, `timer NAME`, `packet`, `telemetry` or `failed_message`.
        argument: The start of a message that arrived or failed; otherwise "".
        position: The position (m) that telemetry reports; None for other calls.
        number: How many calls of this name the node had before.
        effects: What it did, in order.
        cause: What set the timer or sent the message; None for other calls, and if it is unknown.
        frame: Row of the replay's table `frames` that brought the message; None if there is none.
    """

    node: int
    time_ns: int
    name: str
    argument: str = ""
    position: Position | None = None
    number: int = 0
    effects: list[Effect] = field(default_factory=list)
    cause: Cause | None = None
    frame: int | None = None


@dataclass
class CallbackLog:
    """Callbacks of all protocols in Python, in the order of their calls.

    Telemetry is left out if the protocol did nothing.

    Attributes:
        callbacks: The calls.
        canceled: {timer that was canceled: (index of the callback that did it, its due time in ns)}.
    """

    callbacks: list[Callback] = field(default_factory=list)
    canceled: dict[Cause, tuple[int, int]] = field(default_factory=dict)
    _texts: dict[str, str] = field(default_factory=dict)

    def watch(self, run: ScenarioRun, scenario: Scenario) -> None:
        """Log the callbacks of a run, before its start."""
        for spec in scenario.nodes:
            if not is_native(spec):
                node = run.node(spec.name)
                _NodeLog(self, run, spec.id, node.protocol, node.provider)

    def text(self, message: str) -> str:
        """Return the start of a message; the same object for equal ones, so that files are small."""
        start = message[:_KEPT]
        return self._texts.setdefault(start, start)


class _NodeLog:
    """Adds the callbacks of one node to the log."""

    def __init__(
        self, log: CallbackLog, run: ScenarioRun, node: int, protocol: IProtocol, provider: IProvider
    ) -> None:
        self._log, self._run, self._node = log, run, node
        self._provider = provider
        self._callback: Callback | None = None
        self._index = 0
        self._counts: Counter[str] = Counter()
        self._made: Counter[str] = Counter()
        self._pending: defaultdict[str, list[tuple[float, int, Cause | None]]] = defaultdict(list)
        self._timer_count = 0
        self._state = _state(protocol, provider)
        protocol.__class__ = _watched(type(protocol), self._called)
        for name in ("send_communication_command", "send_mobility_command", "schedule_timer", "cancel_timer"):
            setattr(provider, name, partial(getattr(self, f"_{name}"), getattr(provider, name)))

    def _called(self, protocol: IProtocol, name: str, method: Callable[..., Any], *arguments: Any) -> Any:
        if self._callback is not None:  # a protocol or a plugin calls it
            return method(*arguments)
        callback = self._begin(name, *arguments)
        try:
            result = method(*arguments)
        except Exception as failure:
            first_line = next(iter(str(failure).splitlines()), "")
            callback.effects.append(Effect("raise", type(failure).__name__, first_line))
            self._end(callback)
            raise
        before, self._state = self._state, _state(protocol, self._provider)
        if self._state != before:
            callback.effects += _changes(before, self._state)
        self._end(callback)
        return result

    def _begin(self, name: str, *arguments: Any) -> Callback:
        name = name.removeprefix("handle_")
        callback = Callback(self._node, self._now_ns(), name)
        if name == "timer":
            callback.name = f"timer {arguments[0]}"
            pending = self._pending[arguments[0]]
            callback.cause = heappop(pending)[2] if pending else None
        elif name in ("packet", "failed_message"):
            callback.argument = self._log.text(arguments[0])
        elif name == "telemetry":
            callback.position = arguments[0].current_position
        callback.number = self._counts[callback.name]
        self._counts[callback.name] += 1
        self._callback, self._index = callback, len(self._log.callbacks)
        self._log.callbacks.append(callback)
        self._made.clear()
        return callback

    def _end(self, callback: Callback) -> None:
        self._callback = None
        if callback.name == "telemetry" and not callback.effects:
            self._log.callbacks.pop()

    def _now_ns(self) -> int:
        return round(self._run.time_s * _NS_PER_S)

    def _cause(self, kind: str) -> Cause | None:
        if self._callback is None:
            return None
        number = self._made[kind]
        self._made[kind] += 1
        return Cause(self._index, kind, number)

    def _add(self, action: Action, what: str | int, value: object) -> None:
        if self._callback is not None:
            self._callback.effects.append(Effect(action, what, value))

    def _send_communication_command(
        self, send: Callable[[CommunicationCommand], None], command: CommunicationCommand
    ) -> None:
        send(command)
        destination = command.destination or 0
        if command.command_type == CommunicationCommandType.BROADCAST:
            destination = BROADCAST
        elif isinstance(destination, str):
            destination = self._provider.id_of(destination)
        self._add("send", int(destination), self._log.text(command.message))

    def _send_mobility_command(
        self, send: Callable[[MobilityCommand], None], command: MobilityCommand
    ) -> None:
        send(command)
        self._add("move", command.command_type.name, None)

    def _schedule_timer(self, schedule: Callable[[str, float], None], timer: str, timestamp: float) -> None:
        schedule(timer, timestamp)
        self._timer_count += 1  # timers of one time expire in the order in which they were set
        cause = self._cause(f"timer {without_numbers(timer)}")
        heappush(self._pending[timer], (timestamp, self._timer_count, cause))
        self._add("timer", timer, None)

    def _cancel_timer(self, cancel: Callable[[str], None], timer: str) -> None:
        cancel(timer)
        own_time = self._provider.current_time()
        for timestamp, _, cause in self._pending.pop(timer, ()):
            if cause is not None and self._callback is not None:
                due_ns = self._now_ns() + round((timestamp - own_time) * _NS_PER_S)
                self._log.canceled[cause] = (self._index, due_ns)
        self._add("cancel", timer, None)


def _watched(protocol: type[IProtocol], called: Callable[..., Any]) -> type[IProtocol]:
    """Return a subclass whose callbacks go through `called(protocol, name, method, *arguments)`.

    The callbacks are data descriptors, so that they come before what plugins assign to the instance.
    """
    subclass: type[IProtocol] = type(protocol.__name__, (protocol,), {"__module__": protocol.__module__})
    for name in filter(partial(hasattr, protocol), _LOGGED):
        setattr(subclass, name, _Watched(protocol, name, called))
    return subclass


class _Watched:
    def __init__(self, protocol: type[IProtocol], name: str, called: Callable[..., Any]) -> None:
        self._protocol, self._name, self._called = protocol, name, called

    def __get__(self, instance: IProtocol | None, owner: type[IProtocol]) -> Any:
        if instance is None:
            return getattr(self._protocol, self._name)
        method = vars(instance).get(self._name)
        if method is None:
            method = getattr(self._protocol, self._name).__get__(instance, owner)
        return partial(self._called, instance, self._name, method)

    def __set__(self, instance: IProtocol, value: object) -> None:
        vars(instance)[self._name] = value


def _state(protocol: IProtocol, provider: IProvider) -> _State:
    variables = {name: _value(value) for name, value in provider.tracked_variables.items()}
    return variables, {name: _value(value) for name, value in vars(protocol).items()}


def _value(value: object) -> object:
    """Return a string, bool, number or None as it is; otherwise the type, and the length if it has one."""
    kind = type(value)
    if kind in _PLAIN:
        return value
    if kind in _CONTAINERS:
        return kind.__name__, len(value)  # type: ignore[arg-type]
    number = as_float(value)
    return (kind.__name__,) if number is None else number


def _changes(before: _State, after: _State) -> Iterator[Effect]:
    actions: tuple[Action, Action] = ("set", "attribute")
    for action, old, new in zip(actions, before, after, strict=True):
        for name, value in new.items():
            if name not in old or old[name] != value:
                yield Effect(action, str(name), value)
