"""The history of a protocol's tracked variables: which value each one had, from when on."""

from collections.abc import Callable
from typing import Any, NamedTuple

_COMPARABLE = frozenset({bool, int, float, str, type(None)})
_NEVER = object()


class TrackedValue(NamedTuple):
    """One change: from `time_s` seconds of simulated time on, the variable `name` was `value`."""

    time_s: float
    name: str
    value: Any


class TrackedHistory:
    """Notes changes with their times, in order.

    A plain number, text or truth value that is assigned again is no change, so that a protocol which repeats
    itself a hundred times a second does not fill the memory. Lists and other objects are noted as they are,
    not copied: what is changed inside of one later shows in its earlier entries too.
    """

    def __init__(self, current_time: Callable[[], float]) -> None:
        """Start empty; `current_time()` gives the simulated time in seconds."""
        self._current_time = current_time
        self._last: dict[str, Any] = {}
        # Apart and not as one list of changes: millions of those would keep the garbage collector busy.
        self._times_s: list[float] = []
        self._names: list[str] = []
        self._values: list[Any] = []

    @property
    def values(self) -> list[TrackedValue]:
        """The changes, in the order in which they happened."""
        return list(map(TrackedValue, self._times_s, self._names, self._values))

    def note(self, name: str, value: Any) -> None:
        """Note that the variable `name` now is `value`; None for one that was removed."""
        kind = type(value)
        last = self._last.get(name, _NEVER)
        if kind in _COMPARABLE and (last is value or (type(last) is kind and last == value)):
            return
        self._last[name] = value
        self._times_s.append(self._current_time())
        self._names.append(name)
        self._values.append(value)
