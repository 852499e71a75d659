"""The tracked variables of a protocol: validation, and reports of each change."""

from collections.abc import Callable, Iterator, Mapping, MutableMapping
from functools import cache
from typing import Any, Self

from gradysim.protocol.interface import IProvider

_set_item = dict.__setitem__  # looked up once: this is the hot path


def check_variables(variables: object) -> None:
    """Raise TypeError if `variables` is not a mapping."""
    if not isinstance(variables, Mapping):
        raise TypeError(f"tracked_variables = {variables!r:.80}: expected a dict")


class CheckedProvider(IProvider):
    """Provider that rejects invalid assignments to `tracked_variables`, in the callback that makes them."""

    def __setattr__(self, name: str, value: Any) -> None:
        # Not a property: each access would cost more.
        if name == "tracked_variables":
            check_variables(value)
        super().__setattr__(name, value)


class TrackedVariables(dict[str, Any]):
    """Dict that reports every item that is set or removed, by any method.

    Setting an item to its current value is reported, too. A change inside a value, such as an element
    appended to a list, is not seen.
    """

    __slots__ = ("_on_change",)  # so that `tracked_variables.x = 5` is an error, as for a dict

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

    setdefault = MutableMapping.setdefault  # sets one item, by __setitem__
    update = MutableMapping.update  # sets one item after another

    def __ior__(self, other: Any) -> Self:  # type: ignore[override, misc]  # dict declares two overloads
        self.update(other)
        return self

    def pop(self, name: str, *default: Any) -> Any:
        """Like `dict.pop`; reported if the item was there."""
        if name not in self and default:
            return default[0]
        value = self[name]
        del self[name]
        return value

    def popitem(self) -> tuple[str, Any]:
        """Like `dict.popitem`; reported."""
        name, value = super().popitem()
        self._on_change(name, None)
        return name, value

    def clear(self) -> None:
        """Like `dict.clear`; each item is reported."""
        for name in list(self):
            del self[name]

    def replace(self, variables: Mapping[str, Any]) -> None:
        """Become equal to the mapping that a protocol has assigned. Removals are reported first.

        Nothing is reported for this dict itself, which `provider.tracked_variables |= {"b": 2}` assigns.
        """
        check_variables(variables)
        if variables is self:
            return
        values = dict(variables)
        for name in [name for name in self if name not in values]:
            del self[name]
        self.update(values)

    def __reduce__(self) -> tuple[type, tuple[()], None, None, Iterator[tuple[str, Any]]]:
        """Make every copy, also a deep or a pickled one, a plain dict whose changes are not reported."""
        return (dict, (), None, None, iter(self.items()))


def watch_tracked_variables(provider: IProvider, on_change: Callable[[str, Any], None]) -> None:
    """Call `on_change(name, value)` after each change from now on, with None for a removed variable.

    The class of the provider becomes a subclass in which `tracked_variables` is a property. So a dict that
    the protocol assigns is watched, too. Other providers keep their plain attribute, which is faster.
    """
    watched = TrackedVariables(on_change)
    watched.update(vars(provider).pop("tracked_variables"))
    provider.__class__ = _watched(type(provider))
    provider._watched_variables = watched  # type: ignore[attr-defined]


@cache
def _watched(provider_class: type[IProvider]) -> type[IProvider]:
    """Return a subclass of `provider_class` that notices when `tracked_variables` is assigned."""

    def get(self: Any) -> TrackedVariables:
        variables: TrackedVariables = self._watched_variables
        return variables

    def assign(self: Any, variables: dict[str, Any]) -> None:
        self._watched_variables.replace(variables)

    return type(
        provider_class.__name__,
        (provider_class,),
        {"__module__": provider_class.__module__, "tracked_variables": property(get, assign)},
    )
