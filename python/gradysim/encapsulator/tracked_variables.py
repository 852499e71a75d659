"""A dictionary that reports how it changes: a protocol's tracked variables."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any, Self

_set_item = dict.__setitem__  # looked up once: this is the hot path


def check_variables(variables: object) -> None:
    """Raise TypeError for what are no tracked variables."""
    if not isinstance(variables, Mapping):
        raise TypeError(f"tracked_variables = {variables!r:.80}: expected a dict")


class TrackedVariables(dict[str, Any]):
    """Behaves as a dict and reports every item that is set or removed, by whatever method.

    Setting an item to the value that it has is reported too. What changes inside a value, such as an
    element appended to a list, cannot be seen.
    """

    __slots__ = ("_on_change",)  # so that `tracked_variables.x = 5` is an error, as it is of a dict

    def __init__(self, on_change: Callable[[str, Any], None]) -> None:
        """Start empty. `on_change(name, value)` is called after each change, with None for a removed item."""
        super().__init__()
        self._on_change = on_change

    def __setitem__(self, name: str, value: Any) -> None:
        _set_item(self, name, value)
        self._on_change(name, value)

    def __delitem__(self, name: str) -> None:
        super().__delitem__(name)
        self._on_change(name, None)

    def setdefault(self, name: str, default: Any = None) -> Any:
        """As of dict; reported if the item is new."""
        if name not in self:
            self[name] = default
        return self[name]

    def update(self, *others: Any, **items: Any) -> None:
        """As of dict; each item is reported."""
        for name, value in dict(*others, **items).items():
            self[name] = value

    def __ior__(self, other: Any) -> Self:  # type: ignore[override, misc]  # dict declares two overloads
        self.update(other)
        return self

    def pop(self, name: str, *default: Any) -> Any:
        """As of dict; reported if the item was there."""
        present = name in self
        value = super().pop(name, *default)
        if present:
            self._on_change(name, None)
        return value

    def popitem(self) -> tuple[str, Any]:
        """As of dict; reported."""
        name, value = super().popitem()
        self._on_change(name, None)
        return name, value

    def clear(self) -> None:
        """As of dict; each item is reported."""
        names = list(self)
        super().clear()
        for name in names:
            self._on_change(name, None)

    def replace(self, variables: Mapping[str, Any]) -> None:
        """Become equal to `variables`, for a protocol that assigns another dict; removals come first.

        Nothing is reported if they are this very dict: `provider.tracked_variables |= {"b": 2}` assigns it.
        Raises TypeError for what is no dict.
        """
        check_variables(variables)
        if variables is self:
            return
        values = dict(variables)
        for name in [name for name in self if name not in values]:
            del self[name]
        self.update(values)

    def __reduce__(self) -> tuple[type, tuple[()], None, None, Iterator[tuple[str, Any]]]:
        """A copy, also a deep or a pickled one, is a plain dict: changes of it are none of the protocol's."""
        return (dict, (), None, None, iter(self.items()))
