"""The engine's events as handlers see them."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gradysim.simulator.event import EventLoopException

if TYPE_CHECKING:
    from gradysim._netsim import Network


class EngineEventLoop:
    """Stands for `gradysim.simulator.event.EventLoop` in what `INodeHandler.inject` gives to a handler.

    Events of handlers are events of the engine, which runs them: here they cannot be popped or cancelled.
    """

    def __init__(self, network: "Network") -> None:
        self._network = network

    @property
    def current_time(self) -> float:
        """Simulated time in seconds."""
        return self._network.now

    def __len__(self) -> int:
        """Return the number of pending events: those of the network, and those of all handlers."""
        return self._network.pending_count

    def schedule_event(
        self, timestamp: float, callback: Callable[[], Any], context: str = ""
    ) -> tuple[Callable[[], Any], str]:
        """Have `callback()` called at `timestamp`, after all events scheduled for that time so far.

        Args:
            timestamp: Absolute simulated time in seconds, not before `current_time`; taken to the nearest ps.
            callback: Takes no arguments; what it raises ends the run.
            context: What the event is about; not used in this mode.

        Raises:
            EventLoopException: The time is in the past or no time, or the callback cannot be called.
        """
        if not callable(callback):
            raise EventLoopException(f"an event's callback must be callable, got {callback!r}")
        try:
            self._network.schedule(timestamp, callback)
        except (TypeError, RuntimeError) as error:  # the engine's SimulationError is one
            raise EventLoopException(
                f"cannot schedule an event at {timestamp!r}: expected a finite number of seconds, "
                f"at or after the current time, {self.current_time} s"
            ) from error
        return (callback, context)

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(
            f"the event loop has no {name!r} in integrated mode, where the engine runs the events: handlers "
            "use schedule_event, current_time and len()"
        )
