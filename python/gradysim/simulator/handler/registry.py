"""Handler registry: checks the handlers that are given to a run, and calls their hooks."""

import logging
from collections.abc import Callable, Collection, Iterable

from gradysim.simulator.handler.interface import IAsyncNodeHandler, INodeHandler

_logger = logging.getLogger(__name__)

StepHook = Callable[[int, float], None]

WORLD = ("communication", "timer", "mobility", "computer")
"""Labels of handlers that every run of a scenario makes itself."""


def label_of(handler: INodeHandler) -> str:
    """Return a handler's label. TypeError if it is not a handler."""
    if isinstance(handler, type) or not callable(getattr(handler, "get_label", None)):
        raise TypeError(f"expected a handler, an instance of a class like INodeHandler, got {handler!r}")
    return handler.get_label()


def handlers_by_label(
    handlers: Iterable[INodeHandler], mode: str, world: str, *, asynchronous: bool
) -> dict[str, INodeHandler]:
    """Return `handlers` by label, in the given order.

    `mode` is the name of the mode, and `world` what is said of a label in `WORLD`. Raise TypeError if there
    is something else than a handler, and ValueError if a handler does not work in this mode or two have the
    same label.
    """
    if not isinstance(handlers, Iterable):
        raise TypeError(f"expected a list of handlers, got {handlers!r}")
    by_label: dict[str, INodeHandler] = {}
    for handler in handlers:
        label, name = label_of(handler), type(handler).__name__
        if label in WORLD:
            raise ValueError(f"{name} cannot be given to a run in {mode}: {world.format(label=label)}")
        if isinstance(handler, IAsyncNodeHandler) and not asynchronous:
            raise ValueError(f"{name} uses asyncio, which {mode} does not support")
        if label in by_label:
            raise ValueError(
                f"two handlers are labeled {label!r}: {type(by_label[label]).__name__} and {name}; "
                "a run has one of each label"
            )
        by_label[label] = handler
    return by_label


def step_hooks(handlers: Collection[INodeHandler]) -> list[StepHook]:
    """Return the `after_simulation_step` methods that are overridden."""
    own = INodeHandler.after_simulation_step
    hooks = (handler.after_simulation_step for handler in handlers)
    return [hook for hook in hooks if getattr(hook, "__func__", None) is not own]


def stop_judging(handlers: Iterable[INodeHandler]) -> None:
    """Notify handlers such as assertions that the run ends early, so that they report nothing."""
    for handler in handlers:
        if (stop := getattr(handler, "stop_judging", None)) is not None:
            stop()


def finalize_after_failure(live: list[INodeHandler]) -> None:
    """Finalize the handlers of a failed run, and remove them from the list.

    Their exceptions are logged, so that they do not hide the failure.
    """
    stop_judging(live)
    while live:
        handler = live.pop(0)
        try:
            handler.finalize()
        except Exception:
            _logger.exception("The handler %s failed to finalize, too", handler.get_label())
