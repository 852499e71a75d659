"""What happens between two events of a simulation: waiting for the wall clock, and running asyncio."""

import asyncio
import logging
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from gradysim.simulator.event import EventLoop, ScheduledEvent
from gradysim.simulator.profiling import TimingReport
from gradysim.simulator.real_time import RealTimePacer
from gradysim.sitl.nested_loop import outer_loop_stands

_logger = logging.getLogger(__name__)


class AsyncioRunner:
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

    def __init__(self, turns: AsyncioRunner) -> None:
        super().__init__()
        self._turns = turns

    def _open(self, timestamp: float) -> list[ScheduledEvent]:
        events = super()._open(timestamp)
        self._turns.wake()
        return events


class Pacing:
    """Waits before each event of a simulation as long as it takes."""

    def __init__(
        self,
        event_loop: EventLoop,
        until_s: float,
        *,
        pacer: RealTimePacer | None,
        turns: AsyncioRunner | None,
        report: TimingReport | None,
        held_up_s: Callable[[], float],
    ) -> None:
        """Take what is asked for of the simulation.

        Args:
            event_loop: Its events.
            until_s: No event after that simulated time will run.
            pacer: Keeps to the wall clock; None for full speed.
            turns: Gives asyncio its turns; None if no handler uses it.
            report: Is told of each event, if there is a pacer.
            held_up_s: Returns the wall seconds for which the handlers held the simulation up so far.
        """
        self._event_loop = event_loop
        self._until_s = until_s
        self._pacer = pacer
        self._turns = turns
        self._report = report
        self._held_up_s = held_up_s

    def before_each(self, iterations: Iterable[int]) -> Iterator[int]:
        """Pass on the numbers of events, each one when its event is due."""
        for iteration in iterations:
            self._wait(iteration)
            yield iteration

    def _wait(self, iteration: int) -> None:
        pacer = self._pacer
        if pacer is None:
            if self._turns is not None:
                self._turns.take(0.0)
            return
        pacer.held_up_s = self._held_up_s()
        next_time = self._next_time()
        if next_time is None:
            return
        ahead_s = pacer.remaining_s(next_time)
        if self._turns is None:
            pacer.wait_until(next_time)
        else:
            next_time = self._wait_with_asyncio(next_time, pacer, self._turns)
        if self._report is not None and next_time is not None:
            self._report.note(iteration, next_time, pacer.elapsed_s, ahead_s, -pacer.remaining_s(next_time))

    def _wait_with_asyncio(
        self, next_time: float | None, pacer: RealTimePacer, turns: AsyncioRunner
    ) -> float | None:
        """Wait for the next event, which a task may bring forward; return its time."""
        while next_time is not None:
            remaining = pacer.remaining_s(next_time)
            turns.take(max(0.0, remaining))
            next_time = self._next_time()
            if remaining <= 0:
                break
        return next_time

    def _next_time(self) -> float | None:
        next_time = self._event_loop.next_time()
        return None if next_time is None or next_time > self._until_s else next_time
