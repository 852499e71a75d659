"""Simulations that do not wait for the wall clock, whatever their configurations say.

For scripts that test or train with simulations in real time. That all simulations share this is as in the
published package: who makes them need not know of it.
"""

from types import TracebackType
from typing import Self

_contexts = 0


class FullSpeed:
    """Simulations that start in this context do not wait."""

    def __enter__(self) -> Self:
        global _contexts
        _contexts += 1
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        exception: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        global _contexts
        _contexts -= 1


def is_full_speed() -> bool:
    """Return whether this is in such a context."""
    return _contexts > 0
