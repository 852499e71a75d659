"""Executor of runs in groups, by the workers of any other executor, such as a cluster.

A task of a cluster costs milliseconds in the scheduler and a process at the worker. A group of runs takes a
few seconds, so that this does not matter. Towards the end groups become smaller: no worker waits for long.
"""

import time
from collections import deque
from concurrent.futures import FIRST_COMPLETED, CancelledError, Future, wait
from dataclasses import replace

from gradysim.cli.executors import Workers
from gradysim.cli.group import KILLING, Group, GroupResult, compute, press
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.run_all import may_others_go_on
from gradysim.cli.run_task import Reported
from gradysim.cli.runner import RunFuture, WorkerError

_GROUP_S = 5.0
"""Wall time in seconds that a group should take."""

_SHORTEST_GROUP_S = 2.0
"""Of the last groups."""

_GROUPS_PER_WORKER = 2
"""One that is computed, and the next one."""

_POLL_S = 0.1
"""Wall time in seconds until Ctrl-C is passed on."""


class GroupExecutor:
    """Submits runs in groups to the executor of workers.

    The first groups have one run each. Later ones take about 5 s, by the run time of the group before.
    """

    def __init__(
        self,
        workers: Workers,
        group: Group,
        interrupt: StopOnInterrupt,
    ) -> None:
        """Prepare.

        Args:
            workers: They compute the groups. The caller shuts their executor down.
            group: What all groups have in common. Each gets its own numbers.
            interrupt: Ctrl-C: afterwards no run starts. Those under way get each press.
        """
        self._workers = workers
        self._group = group
        self._interrupt = interrupt
        interrupt.workers = ()  # the groups are the workers, and `advance` forwards to them
        self._is_over = False
        self._waiting: deque[tuple[int, RunFuture[Reported]]] = deque()
        self._groups: dict[Future[GroupResult], dict[int, RunFuture[Reported]]] = {}
        self._run_s: float | None = None

    def submit(self, number: int) -> RunFuture[Reported]:
        """Submit the run of this number."""
        future: RunFuture[Reported] = RunFuture(self.advance)
        self._waiting.append((number, future))
        return future

    def close(self) -> None:
        """Kill the groups that have not ended."""
        if self._groups:
            self._workers.call_each(press, self._group.command, KILLING)

    def advance(self) -> None:
        """Submit groups while there is room, and wait for the end of one, or for Ctrl-C.

        Raises WorkersLostError, and KeyboardInterrupt if no worker can take the Ctrl-C.
        """
        workers = self._workers.count()
        if self._is_over or self._interrupt.should_stop():
            self._stop()
            if not workers and self._interrupt.should_stop():
                raise KeyboardInterrupt
        while self._waiting and len(self._groups) < _GROUPS_PER_WORKER * workers:
            self._submit_group(self._next_size(workers))
        if self._groups:
            wait(self._groups, _POLL_S, FIRST_COMPLETED)
        else:
            time.sleep(_POLL_S)
        for group in [group for group in self._groups if group.done()]:
            self._finish(group, self._groups.pop(group))

    def _next_size(self, workers: int) -> int:
        """Return the number of runs in the next group."""
        if self._run_s is None:
            return 1
        even = len(self._waiting) / (_GROUPS_PER_WORKER * workers)
        shortest, longest = (duration_s / self._run_s for duration_s in (_SHORTEST_GROUP_S, _GROUP_S))
        return max(1, round(min(max(even, shortest), longest)))

    def _submit_group(self, size: int) -> None:
        futures: dict[int, RunFuture[Reported]] = {}
        while self._waiting and len(futures) < size:
            number, future = self._waiting.popleft()
            if future.set_running_or_notify_cancel():
                futures[number] = future
        if futures:
            self._groups[
                self._workers.executor.submit(compute, replace(self._group, numbers=tuple(futures)))
            ] = futures

    def _finish(self, group: Future[GroupResult], futures: dict[int, RunFuture[Reported]]) -> None:
        """Pass on the results of a group that has ended."""
        try:
            result = group.result()
        except CancelledError:  # not by this class
            raise self._workers.lost() from None
        except Exception as error:  # of the group's process, or of the executor
            for future in futures.values():
                future.set_exception(WorkerError(str(error), None))
            return
        if result.ended:
            self._run_s = max(result.duration_s / len(result.ended), 1e-6)
        for number, future in futures.items():
            ended = result.ended.get(number)
            if ended is None:
                future.set_exception(CancelledError())
                continue
            future.printed = ended.printed
            if isinstance(ended.outcome, WorkerError):
                future.set_exception(ended.outcome)
            else:
                future.set_result(ended.outcome)
            if not may_others_go_on(future):
                self._is_over = True

    def _stop(self) -> None:
        """Let no more run start, also at new workers, and pass on how often Ctrl-C was pressed."""
        while self._waiting:
            self._waiting.popleft()[1].cancel()
        for group in [group for group in self._groups if self._workers.cancel(group)]:
            for future in self._groups.pop(group).values():
                future.set_exception(CancelledError())
        self._workers.call_each(press, self._group.command, self._interrupt.presses)
