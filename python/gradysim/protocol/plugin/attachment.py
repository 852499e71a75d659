"""What a plugin takes from its protocol: its configuration, and the clock and random stream of the provider.

A provider may be a user's mock that has only some of the methods of `IProvider`.
"""

import logging
from dataclasses import fields
from numbers import Real
from random import Random
from typing import Any, TypeVar
from weakref import WeakKeyDictionary

T = TypeVar("T")


def configuration_or_default(plugin: object, given: T | None, kind: type[T]) -> T:
    """Return `given`, or a `kind` with its defaults if `given` is None.

    Raise TypeError if `given` is not such a configuration; for example, if both arguments are exchanged.
    """
    if given is None:
        return kind()
    if not all(hasattr(given, field.name) for field in fields(kind)):  # type: ignore[arg-type]
        call = f"{type(plugin).__name__}(self, {kind.__name__}(...))"
        raise TypeError(f"expected `{call}`, got {given!r} as the configuration")
    return given


def time_of(provider: Any) -> float:
    """Return the current time in seconds; 0 if the provider has no clock."""
    now = provider.current_time() if hasattr(provider, "current_time") else 0.0
    return float(now) if isinstance(now, (float, Real)) else 0.0


def stream_of(provider: Any) -> Random:
    """Return the provider's random stream; if it has none, a stream that depends on the node's id alone."""
    stream = getattr(provider, "random", None)
    if isinstance(stream, Random):
        return stream
    node_id = provider.get_id() if hasattr(provider, "get_id") else 0
    return Random(node_id if isinstance(node_id, int) else 0)


def warn_without_telemetry(logger: logging.Logger, protocol: Any, consequence: str) -> None:
    """Log a warning if the protocol's node has no telemetry: once for each class and consequence."""
    if getattr(protocol.provider, "has_telemetry", True) is not False:
        return
    warned = _warned.setdefault(_written_class(protocol), set())
    if consequence not in warned:
        warned.add(consequence)
        logger.warning(
            "%s %s: %s, since its telemetry interval is 0; expected an interval such as 10ms",
            type(protocol).__name__,
            protocol.provider.get_id(),
            consequence,
        )


_warned: WeakKeyDictionary[type, set[str]] = WeakKeyDictionary()


def _written_class(protocol: object) -> type:
    """Return the class in the user's file. Nodes with parameters have subclasses of the same name."""
    cls = type(protocol)
    return [base for base in cls.__mro__ if base.__qualname__ == cls.__qualname__][-1]
