"""Records runs of the engine for a replay."""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from gradysim.protocol.plain_value import as_float, key_text
from gradysim.replay.chunk import RawChunk
from gradysim.replay.tables import text_of_value
from gradysim.scenario.scenario import Scenario

if TYPE_CHECKING:
    from gradysim._netsim import Network

_LARGE = 1 << 53
"""Integers below are floats, too."""

VariableListener: TypeAlias = Callable[[str, Any], None]
"""Takes the name and the new value of a tracked variable; the value is None if it was removed."""


class EngineRecorder:
    """The engine's recorder, for values of Python."""

    def __init__(self, network: "Network", scenario: Scenario, recorded: frozenset[int]) -> None:
        """Start to record; `recorded` are ids of nodes that are recorded in full."""
        self._recorded = recorded
        self._recorder = network.record(sorted(self._recorded))
        for node in scenario.nodes:
            if node.autopilot is not None or node.is_quadcopter:
                self._recorder.sample_path(node.id)

    def variable_listener(self, node_id: int) -> VariableListener | None:
        """Return what records the tracked variables of a node; None if they are not recorded."""
        if node_id not in self._recorded:
            return None
        set_variable = self._recorder.variable_set

        def tell(name: str, value: Any) -> None:
            kind = type(value)
            if (
                type(name) is str
                and name.isascii()
                and (kind is float or (kind is int and abs(value) < _LARGE))
            ):
                set_variable(node_id, name, value)  # nearly always
                return
            number = None if isinstance(value, bool) else as_float(value)
            told = text_of_value(value) if number is None else number
            set_variable(node_id, _utf8(key_text(name)), told if number is not None else _utf8(str(told)))

        return tell

    def event(self, node_id: int, kind: int, text: str) -> None:
        """Record an event of a kind of `EVENT_KINDS`, by number."""
        self._recorder.event(node_id, kind, _utf8(text))

    def chunks(self, *, cut: bool, last: bool) -> Iterator[RawChunk]:
        """Return the complete chunks; `cut` ends the current one, `last` the record."""
        if last:
            self._recorder.finish()
        elif cut:
            self._recorder.close_chunk()
        for chunk in self._recorder.take():
            yield RawChunk(**chunk)


def _utf8(text: str) -> str:
    """Return a string without characters that UTF-8 cannot encode."""
    return text.encode(errors="replace").decode()
