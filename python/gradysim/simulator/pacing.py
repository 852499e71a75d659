"""Actions between two events of a simulation: waiting for the wall clock, and running asyncio."""

import asyncio
import logging
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from gradysim.encapsulator.nested_loop import outer_loop_stands
from gradysim.simulator.event import EventLoop, ScheduledEvent
from gradysim.simulator.profiling import TimingReport
from gradysim.simulator.real_time import RealTimePacer

_logger = logging.getLogger(__name__)


class AsyncioRunner:
    """Owns an asyncio loop and runs it between the events of a simulation.

    Attributes:
        asyncio_loop: The loop. It does not run during an event, so that a handler may call
            `run_until_complete`.
    """

    def __init__(self) -> None:
        self.asyncio_loop = asyncio.new_event_loop()
        self._failure: BaseException | None = None
        self._runs = False
        self.asyncio_loop.set_exception_handler(self._note_failure)

    def run_for(self, duration_s: float) -> None:
        """Run the loop for `duration_s` wall seconds; for 0, run only what is ready.

        Raise what a callback or a task has raised, if no other task waits for it.
        """
        loop = self.asyncio_loop
        alarm: asyncio.Handle
        alarm = loop.call_later(duration_s, loop.stop) if duration_s > 0 else loop.call_soon(loop.stop)
        self._runs = True
        try:
            with outer_loop_stands():
                loop.run_forever()
        finally:
            self._runs = False
            alarm.cancel()
        failure, self._failure = self._failure, None
        if failure is not None:
            raise failure

    def wake(self) -> None:
        """Return from `run_for` early; no-op outside of it, or while a handler runs the loop itself."""
        if self._runs:
            self.asyncio_loop.stop()

    def close(self) -> None:
        """Cancel all tasks, let them finish and close the loop; no-op if it is closed."""
        loop = self.asyncio_loop
        if loop.is_closed():
            return
        with outer_loop_stands():  # of a notebook, or of other code when the garbage collector closes this
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
                _logger.error("A task failed after the last event", exc_info=self._failure)
            self._failure = None

    def _note_failure(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        exception = context.get("exception")
        if exception is None:
            loop.default_exception_handler(context)
        elif self._failure is None:
            self._failure = exception
            self.wake()


class WakingEventLoop(EventLoop):
    """Returns from asyncio when a task schedules an event, which may be due before all others."""

    def __init__(self, asyncio_runner: AsyncioRunner) -> None:
        super().__init__()
        self._asyncio_runner = asyncio_runner

    def _open(self, timestamp: float) -> list[ScheduledEvent]:
        events = super()._open(timestamp)
        self._asyncio_runner.wake()
        return events


class Pacing:
    """Waits before each event of a simulation."""

    def __init__(
        self,
        event_loop: EventLoop,
        until_s: float,
        *,
        pacer: RealTimePacer | None,
        asyncio_runner: AsyncioRunner | None,
        report: TimingReport | None,
        paused_s: Callable[[], float],
    ) -> None:
        """Wait for events up to the simulated time `until_s`.

        Without a pacer it runs at full speed, without an asyncio runner no handler uses asyncio. The report
        notes each event, if there is a pacer. `paused_s` returns the wall seconds of pauses so far.
        """
        self._event_loop = event_loop
        self._until_s = until_s
        self._pacer = pacer
        self._asyncio_runner = asyncio_runner
        self._report = report
        self._paused_s = paused_s

    def before_each(self, iterations: Iterable[int]) -> Iterator[int]:
        """Yield the numbers of events, each one when its event is due."""
        for iteration in iterations:
            self._wait(iteration)
            yield iteration

    def _wait(self, iteration: int) -> None:
        pacer = self._pacer
        if pacer is None:
            if self._asyncio_runner is not None:
                self._asyncio_runner.run_for(0.0)
            return
        pacer.paused_s = self._paused_s()
        next_time = self._next_time()
        if next_time is None:
            return
        ahead_s = pacer.remaining_s(next_time)
        if self._asyncio_runner is None:
            pacer.wait_until(next_time)
        else:
            next_time = self._wait_with_asyncio(next_time, pacer, self._asyncio_runner)
        if self._report is not None and next_time is not None:
            self._report.note(iteration, next_time, pacer.elapsed_s, ahead_s, -pacer.remaining_s(next_time))

    def _wait_with_asyncio(
        self, next_time: float | None, pacer: RealTimePacer, asyncio_runner: AsyncioRunner
    ) -> float | None:
        """Wait for the next event, which a task may bring forward; return its time."""
        while next_time is not None:
            remaining = pacer.remaining_s(next_time)
            asyncio_runner.run_for(max(0.0, remaining))
            next_time = self._next_time()
            if remaining <= 0:
                break
        return next_time

    def _next_time(self) -> float | None:
        next_time = self._event_loop.next_time()
        return None if next_time is None or next_time > self._until_s else next_time
