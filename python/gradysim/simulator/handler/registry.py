"""The handlers that somebody gives to a run of a scenario: checked, told of its steps, and of its end."""

import logging
from collections.abc import Callable, Collection, Iterable

from gradysim.simulator.handler.interface import IAsyncNodeHandler, INodeHandler

_logger = logging.getLogger(__name__)

StepHook = Callable[[int, float], None]

WORLD = ("communication", "timer", "mobility")
"""Labels of the handlers that make up the world. The run of a scenario has its own, and takes no others."""


def label_of(handler: INodeHandler) -> str:
    """Return a handler's label. TypeError if it is something else than a handler."""
    if isinstance(handler, type) or not callable(getattr(handler, "get_label", None)):
        raise TypeError(f"expected a handler, an instance of a class like INodeHandler, got {handler!r}")
    return handler.get_label()


def handlers_by_label(
    handlers: Iterable[INodeHandler], mode: str, world: str, *, asynchronous: bool
) -> dict[str, INodeHandler]:
    """Return `handlers` by their labels, in the order given.

    Args:
        handlers: Instances, of different labels.
        mode: Name of the mode in which they are to work, for people.
        world: What takes the place of a handler with one of the labels `WORLD` there, for people.
        asynchronous: Whether an `IAsyncNodeHandler` works there.

    Raises:
        TypeError: They are no list, or something else than a handler is among them.
        ValueError: One of them cannot work there, or two have the same label.
    """
    if not isinstance(handlers, Iterable):
        raise TypeError(f"expected a list of handlers, got {handlers!r}")
    by_label: dict[str, INodeHandler] = {}
    for handler in handlers:
        label, name = label_of(handler), type(handler).__name__
        if label in WORLD:
            raise ValueError(f"{name} cannot be given to a run in {mode}: {world.format(label=label)}")
        if isinstance(handler, IAsyncNodeHandler) and not asynchronous:
            raise ValueError(f"{name} waits for the world outside with asyncio, which {mode} does not do")
        if label in by_label:
            raise ValueError(
                f"two handlers are labelled {label!r}: {type(by_label[label]).__name__} and {name}; "
                "a run has one of each label"
            )
        by_label[label] = handler
    return by_label


def step_hooks(handlers: Collection[INodeHandler]) -> list[StepHook]:
    """Return the `after_simulation_step` of those that do something then; most do not, and are not called."""
    return [handler.after_simulation_step for handler in handlers if _has_hook(handler)]


def stop_judging(handlers: Iterable[INodeHandler]) -> None:
    """Tell those that judge a run when it is over, as assertions do, that it ended before it was."""
    for handler in handlers:
        getattr(handler, "stop_judging", _nothing)()


def finalize_after_failure(live: list[INodeHandler]) -> None:
    """Finalize the handlers of a run that failed, and take them from the list.

    What they raise is logged, and does not hide the failure before.
    """
    stop_judging(live)
    while live:
        handler = live.pop(0)
        try:
            handler.finalize()
        except Exception:
            _logger.exception("The handler %s failed to finalize, too", handler.get_label())


def _nothing() -> None: ...


def _has_hook(handler: INodeHandler) -> bool:
    function = getattr(handler.after_simulation_step, "__func__", None)
    return function is not INodeHandler.after_simulation_step
