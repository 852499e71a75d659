"""Base class of extensions."""

import warnings
from collections.abc import Mapping
from typing import Any, ClassVar

from gradysim.encapsulator.python import PythonProvider
from gradysim.protocol.interface import IProtocol, IProvider


class Extension:
    """Base class of extensions, which use the simulator behind a protocol's provider.

    A subclass finds the handlers of prototype mode in `self._provider.handlers`. In other modes `_provider`
    is None, and a warning is issued. An extension that needs only a handler given to the run should use
    `handler_of` instead, which works in integrated mode, too.
    """

    _provider: PythonProvider | None
    """The node's provider in prototype mode; None in other modes."""

    _warns_elsewhere: ClassVar[bool] = True

    def __init__(self, protocol: IProtocol) -> None:
        """Attach to a protocol, in its `initialize` or later.

        Raise ReferenceError if the protocol has no provider yet, as in its constructor.
        """
        provider = provider_of(protocol)
        self._provider = provider if isinstance(provider, PythonProvider) else None
        if self._provider is None and self._warns_elsewhere:
            warnings.warn(
                f"{type(self).__name__} finds no handlers of prototype mode in {mode_of(provider)}: "
                "what it takes from its _provider works in prototype mode only",
                stacklevel=2,
            )


def provider_of(protocol: IProtocol) -> IProvider:
    """Return the provider of a protocol; ReferenceError if it has none yet."""
    provider: IProvider | None = getattr(protocol, "provider", None)
    if provider is None:
        raise ReferenceError(
            f"{type(protocol).__name__} has no provider yet: make its extensions in initialize, "
            "not in the constructor"
        )
    return provider


def handler_of(protocol: IProtocol, label: str) -> Any:
    """Return the handler with that label in the run of a protocol; None if there is none.

    Both modes have handlers; other environments do not. ReferenceError if the protocol has no provider yet.
    """
    handlers: Mapping[str, Any] = getattr(provider_of(protocol), "handlers", {})
    return handlers.get(label)


def mode_of(provider: Any) -> str:
    """Return the name of the mode that a provider belongs to, for messages."""
    return str(getattr(provider, "mode", f"the environment of {type(provider).__name__}"))
