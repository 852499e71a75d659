"""An asyncio loop that runs between the events of a simulation, for handlers in touch with the world."""

import asyncio
import logging
from typing import Any

from gradysim.encapsulator.nested_loop import outer_loop_stands
from gradysim.simulator.event import EventLoop, ScheduledEvent

_logger = logging.getLogger(__name__)


class AsyncioTurns:
    """Owns an asyncio loop and runs it for a while when it is told to; between its turns the loop stands.

    Attributes:
        asyncio_loop: The loop. It does not run while an event does, so that a handler may use
            `run_until_complete` in its own methods.
    """

    def __init__(self) -> None:
        self.asyncio_loop = asyncio.new_event_loop()
        self._failure: BaseException | None = None
        self._is_turn = False
        self.asyncio_loop.set_exception_handler(self._note_failure)

    def take(self, duration_s: float) -> None:
        """Run what is ready, and for `duration_s` wall seconds what becomes so.

        Raises:
            BaseException: What a callback or a task raised, if nobody else waits for that task.
        """
        loop = self.asyncio_loop
        alarm: asyncio.Handle
        alarm = loop.call_later(duration_s, loop.stop) if duration_s > 0 else loop.call_soon(loop.stop)
        self._is_turn = True
        try:
            with outer_loop_stands():
                loop.run_forever()
        finally:
            self._is_turn = False
            alarm.cancel()
        failure, self._failure = self._failure, None
        if failure is not None:
            raise failure

    def wake(self) -> None:
        """End the turn that is under way; no-op if there is none, as while a handler runs the loop itself."""
        if self._is_turn:
            self.asyncio_loop.stop()

    def close(self) -> None:
        """Cancel all tasks, let them finish and close the loop; no-op if that has happened already."""
        loop = self.asyncio_loop
        if loop.is_closed():
            return
        with outer_loop_stands():  # of a notebook, or of whoever runs as the garbage collector closes this
            self._close(loop)

    def _close(self, loop: asyncio.AbstractEventLoop) -> None:
        try:
            tasks = asyncio.all_tasks(loop)
            for task in tasks:
                task.cancel()
            if tasks:
                loop.run_until_complete(asyncio.gather(*tasks, return_exceptions=True))
            loop.run_until_complete(loop.shutdown_asyncgens())
            loop.run_until_complete(loop.shutdown_default_executor())
        finally:
            loop.close()
            if self._failure is not None and not isinstance(self._failure, KeyboardInterrupt):
                _logger.error("A task failed after the last turn of asyncio", exc_info=self._failure)
            self._failure = None

    def _note_failure(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        exception = context.get("exception")
        if exception is None:
            loop.default_exception_handler(context)
        elif self._failure is None:
            self._failure = exception
            self.wake()


class WakingEventLoop(EventLoop):
    """Ends a turn of asyncio when an event is scheduled meanwhile: it may be due before all others."""

    def __init__(self, turns: AsyncioTurns) -> None:
        super().__init__()
        self._turns = turns

    def _open(self, timestamp: float) -> list[ScheduledEvent]:
        events = super()._open(timestamp)
        self._turns.wake()
        return events
