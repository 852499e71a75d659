"""What happens between two events: waiting for the wall clock, and letting asyncio have its turn."""

from collections.abc import Callable, Iterable, Iterator

from gradysim.simulator.asyncio_turns import AsyncioTurns
from gradysim.simulator.event import EventLoop
from gradysim.simulator.real_time import RealTimePacer
from gradysim.simulator.timing_report import TimingReport


class Pacing:
    """Waits before each event of a simulation as long as it takes."""

    def __init__(
        self,
        event_loop: EventLoop,
        until_s: float,
        *,
        pacer: RealTimePacer | None,
        turns: AsyncioTurns | None,
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
        self, next_time: float | None, pacer: RealTimePacer, turns: AsyncioTurns
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
