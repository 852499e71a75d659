"""Trace of all events at protocols, in order, for a comparison between the modes.

The traces of two modes agree if the same nodes have the same callbacks with the same arguments, in one order
for all nodes. They must also send the same commands at the same times, and track the same variables to the
end.

Two kinds of rounding are allowed everywhere. Times: the engine counts in picoseconds, so each timer relative
to the one before may add half of one. Coordinates, also within messages and variables: the prototype adds up
one step per update of the positions, and the engine has a formula. After some thousand steps the two differ
by some 10^-12 m.

To avoid further differences when nodes move, commands to vehicles must be sent just after an update of the
positions, which is the time of telemetry. Otherwise the two modes differ by up to one step: the prototype's
vehicles obey at the next update, the engine's at once. The numbers of a node that gets commands between
updates are compared with a tolerance of some steps, for which its test gives a reason.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import zip_longest
from typing import Any, ClassVar, NamedTuple, cast

import pytest
from perfect_channel import MODES, Case

from gradysim.protocol.interface import IProtocol, IProvider
from gradysim.protocol.position import Position
from gradysim.scenario.scenario import Scenario

UPDATE_S = 0.01
"""Time between two updates of the prototype's positions, and so the telemetry interval of nodes that move."""

ROUNDING_S = 1e-10
ROUNDING_M = 1e-8

CALLBACKS = ("handle_timer", "handle_packet", "handle_telemetry", "finish")
COMMANDS = ("send_communication_command", "send_mobility_command", "schedule_timer", "cancel_timer")

_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


class Entry(NamedTuple):
    """A callback or a command: time, node, name, and arguments as strings."""

    time_s: float
    node: int
    name: str
    arguments: str


@dataclass
class Trace:
    """One run.

    Attributes:
        entries: Callbacks and commands.
        tracked: Variables of each node at the end.
        positions: Final position of each node, in meters.
    """

    entries: list[Entry] = field(default_factory=list)
    tracked: list[str] = field(default_factory=list)
    positions: list[Position] = field(default_factory=list)

    def names(self, node: int | None = None) -> list[str]:
        """Return the names of the entries, of one node or of all."""
        return [entry.name for entry in self.entries if node in (None, entry.node)]


def trace_case(mode: str, case: Case, *protocols: type[IProtocol]) -> Trace:
    """Run the case in one mode and return its trace."""
    return trace_scenario(mode, case.scenario(*protocols))


def trace_scenario(mode: str, scenario: Scenario) -> Trace:
    """Run the scenario in one mode and return its trace."""
    trace = Trace()
    classes = {spec.protocol: _watched(spec.protocol, trace.entries) for spec in scenario.nodes}
    nodes = tuple(replace(spec, protocol=classes[spec.protocol]) for spec in scenario.nodes)
    result = MODES[mode](replace(scenario, nodes=nodes))
    trace.tracked = [repr(dict(node.tracked_variables)) for node in result.nodes]
    trace.positions = [node.position for node in result.nodes]
    return trace


def assert_same(integrated: Trace, prototype: Trace, tolerance_m: Mapping[int, float] | None = None) -> None:
    """Check that two traces agree; `tolerance_m` is the tolerance for the numbers of some nodes."""
    tolerance_m = tolerance_m or {}
    for index, (entry, expected) in enumerate(zip_longest(integrated.entries, prototype.entries)):
        if entry != expected and not _agree(entry, expected, tolerance_m):
            pytest.fail(f"entry {index} in integrated mode: {entry}\nin prototype mode: {expected}")
    for node in range(len(integrated.tracked)):
        tolerance = tolerance_m.get(node, ROUNDING_M)
        for kind, one, other in (
            ("variables", integrated.tracked[node], prototype.tracked[node]),
            ("position", str(integrated.positions[node]), str(prototype.positions[node])),
        ):
            if not _near(one, other, tolerance):
                pytest.fail(f"{kind} of node {node} in integrated mode: {one}\nin prototype mode: {other}")


def _agree(entry: Entry | None, expected: Entry | None, tolerance_m: Mapping[int, float]) -> bool:
    return (
        entry is not None
        and expected is not None
        and entry[1:3] == expected[1:3]
        and abs(entry.time_s - expected.time_s) <= ROUNDING_S
        and _near(entry.arguments, expected.arguments, tolerance_m.get(entry.node, ROUNDING_M))
    )


def _near(text: str, expected: str, tolerance: float) -> bool:
    """Return whether two strings are the same except for small differences of their numbers."""
    return _NUMBER.sub("0", text) == _NUMBER.sub("0", expected) and all(
        abs(number - other) <= tolerance
        for number, other in zip(_numbers(text), _numbers(expected), strict=True)
    )


def _numbers(text: str) -> Sequence[float]:
    return [float(number) for number in _NUMBER.findall(text)]


def _watched(protocol: type[IProtocol], entries: list[Entry]) -> type[IProtocol]:
    """Return the protocol with a trace outside of its plugins, with the same name, which statistics use."""

    class Watched(protocol):  # type: ignore[misc, valid-type]
        entries_: ClassVar[list[Entry]] = entries

        @classmethod
        def instantiate(cls, provider: IProvider) -> IProtocol:
            _watch(provider, COMMANDS, provider, entries)
            return cast("IProtocol", super().instantiate(provider))

        def initialize(self) -> None:
            entries.append(Entry(self.provider.current_time(), self.provider.get_id(), "initialize", "()"))
            super().initialize()
            _watch(self, CALLBACKS, self.provider, entries)

    Watched.__name__ = protocol.__name__
    return Watched


def _watch(target: Any, methods: Sequence[str], provider: IProvider, entries: list[Entry]) -> None:
    """Log the calls of these methods, each before it is executed."""

    def watch(name: str, method: Callable[..., None]) -> Callable[..., None]:
        def noted(*arguments: Any) -> None:
            entries.append(Entry(provider.current_time(), provider.get_id(), name, repr(arguments)))
            method(*arguments)

        return noted

    for name in methods:
        setattr(target, name, watch(name, getattr(target, name)))
