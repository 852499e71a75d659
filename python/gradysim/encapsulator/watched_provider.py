"""Lets somebody know of each change of the tracked variables of one protocol."""

from collections.abc import Callable
from functools import cache
from typing import Any

from gradysim.encapsulator.tracked_variables import TrackedVariables
from gradysim.protocol.interface import IProvider


def watch_tracked_variables(provider: IProvider, on_change: Callable[[str, Any], None]) -> None:
    """Call `on_change(name, value)` after each change from now on, with None for a removed variable.

    The provider becomes one of a subclass, whose `tracked_variables` is a property: a protocol may assign
    another dictionary, and is still watched. Those that nobody watches keep their plain attribute, which
    costs less.
    """
    watched = TrackedVariables(on_change)
    watched.update(vars(provider).pop("tracked_variables"))
    provider.__class__ = _watched(type(provider))
    provider._watched_variables = watched  # type: ignore[attr-defined]


@cache
def _watched(provider_class: type[IProvider]) -> type[IProvider]:
    """Return a class of providers like `provider_class` that see when other variables are assigned."""

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
