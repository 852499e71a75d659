"""All that happens to protocols, in order, so that it can be compared between the modes.

The traces of two modes agree if the same nodes are called with the same arguments and give the same commands,
in one order for all nodes, at the same times, and track the same variables to the end.

Two roundings are allowed for, everywhere. Times: the engine counts in picoseconds, so each timer that is set
relative to the one before may add half of one. Coordinates, also within
messages and variables: the prototype adds up one step for each update of the positions, where the engine has
a formula; after some thousand steps the two are some 10^-12 m apart.

So that nothing more than that differs when nodes move, orders to vehicles have to be given when a position
has just been updated, which is when telemetry comes. In between the two modes differ by up to one step: the
prototype's vehicles obey from the update after the order on, the engine's at once. The numbers of a node that
does get orders in between are compared with a tolerance of some steps, which its test gives a reason for.
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
    """A callback or a command: when, of which node, its name and its arguments as they print."""

    time_s: float
    node: int
    name: str
    arguments: str


@dataclass
class Trace:
    """One run.

    Attributes:
        entries: What happened.
        tracked: The variables of each node at the end.
        positions: Where each node ended, in meters.
    """

    entries: list[Entry] = field(default_factory=list)
    tracked: list[str] = field(default_factory=list)
    positions: list[Position] = field(default_factory=list)

    def names(self, node: int | None = None) -> list[str]:
        """The names of the entries, of one node or of all."""
        return [entry.name for entry in self.entries if node in (None, entry.node)]


def trace_case(mode: str, case: Case, *protocols: type[IProtocol]) -> Trace:
    """Run the case in one mode and watch."""
    return trace_scenario(mode, case.scenario(*protocols))


def trace_scenario(mode: str, scenario: Scenario) -> Trace:
    """Run the scenario in one mode and watch."""
    trace = Trace()
    classes = {spec.protocol: _watched(spec.protocol, trace.entries) for spec in scenario.nodes}
    nodes = tuple(replace(spec, protocol=classes[spec.protocol]) for spec in scenario.nodes)
    result = MODES[mode](replace(scenario, nodes=nodes))
    trace.tracked = [repr(dict(node.tracked_variables)) for node in result.nodes]
    trace.positions = [node.position for node in result.nodes]
    return trace


def assert_same(integrated: Trace, prototype: Trace, tolerance_m: Mapping[int, float] | None = None) -> None:
    """Two traces agree; `tolerance_m` says for some nodes by how much their numbers may differ."""
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
    """Whether two texts are the same but for their numbers, which hardly differ."""
    return _NUMBER.sub("0", text) == _NUMBER.sub("0", expected) and all(
        abs(number - other) <= tolerance
        for number, other in zip(_numbers(text), _numbers(expected), strict=True)
    )


def _numbers(text: str) -> Sequence[float]:
    return [float(number) for number in _NUMBER.findall(text)]


def _watched(protocol: type[IProtocol], entries: list[Entry]) -> type[IProtocol]:
    """The protocol, outside of all its plugins; of the same name, which statistics use."""

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
    """Note the calls of these methods, each before it is carried out."""

    def watch(name: str, method: Callable[..., None]) -> Callable[..., None]:
        def noted(*arguments: Any) -> None:
            entries.append(Entry(provider.current_time(), provider.get_id(), name, repr(arguments)))
            method(*arguments)

        return noted

    for name in methods:
        setattr(target, name, watch(name, getattr(target, name)))
