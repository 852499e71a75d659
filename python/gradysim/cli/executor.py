"""The executor of runs: the numbers of runs go in, and a row for each run that has ended comes out.

Workers compute the runs: forked processes of this machine, or those of any other executor, such as a cluster.
They get runs in batches. A task of a cluster costs milliseconds in the scheduler and a process at the worker,
so that a batch takes a few seconds there. Towards the end batches become smaller: no worker waits for long.
"""

from bisect import bisect_left
from collections.abc import Collection, Iterable, Iterator, Sequence
from concurrent.futures import CancelledError, Future
from dataclasses import dataclass
from typing import Protocol, Self

from gradysim.cli.errors import LOCKED, MISTAKE, OK, OVER_MEMORY
from gradysim.cli.interrupt import KILLING, StopOnInterrupt

_OTHERS_GO_ON = {OK, LOCKED, OVER_MEMORY}
"""Exit codes of runs that do not stop the others."""

_MOST_AHEAD = 10_000
"""Number of runs from the first one under way to the last one that may begin.

Output is printed in order. If the first run hangs, that of the others stays in memory.
"""


class WorkersLostError(Exception):
    """No worker computes the batches that have begun, or it cannot report them."""


@dataclass(frozen=True)
class Row:
    """How a run ended.

    Attributes:
        number: Number of the run.
        code: Its exit code.
        output_error: The error if the standard output of its process takes no more.
        death: How its process died, or why it could not start; "" if it returned.
        printed: Its output to standard output and standard error; empty if it is there already.
        wall_s: Wall time of its process in seconds.
    """

    number: int
    code: int
    output_error: OSError | None = None
    death: str = ""
    printed: tuple[bytes, ...] = ()
    wall_s: float = 0.0

    @property
    def lets_others_begin(self) -> bool:
        """Whether other runs may begin afterwards. The death of a process is not their failure."""
        if self.death:
            return self.code != MISTAKE
        return self.code in _OTHERS_GO_ON and self.output_error is None


Batch = Future[list[Row]]
"""Runs that a worker computes. A run without a row did not begin."""


class Workers(Protocol):
    """What computes batches of runs.

    Attributes:
        batch_s: Shortest and longest wall time in seconds that a batch should take. A batch has at least one
            run.
    """

    batch_s: tuple[float, float]

    def count(self) -> int:
        """Return how many batches are computed at the same time. Raises WorkersLostError."""

    def begin(self, numbers: tuple[int, ...]) -> Batch:
        """Begin a batch of the runs of these numbers."""

    def wait(self, batches: Collection[Batch]) -> None:
        """Wait for the end of one of these batches, or for a short while."""

    def stop(self, batches: Iterable[Batch], presses: int) -> list[Batch]:
        """Let no more run begin in these batches, and pass on the number of presses of Ctrl-C.

        Returns the batches that were canceled. `KILLING` presses kill the processes of all batches.
        """

    def lost(self) -> WorkersLostError:
        """Return the error after a batch was canceled otherwise."""


class RunExecutor:
    """Computes runs by workers, until one ends so that no other may begin, or until Ctrl-C.

    The first batches have one run each. The size of later ones goes by the wall times of the runs so far. At
    the end of the `with` block, batches that have not ended are killed.
    """

    def __init__(self, workers: Workers, interrupt: StopOnInterrupt) -> None:
        self._workers = workers
        self._interrupt = interrupt
        self._is_over = False
        self._batches: dict[Batch, tuple[int, ...]] = {}
        self._run_s: float | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._batches:
            self._workers.stop(self._batches, KILLING)

    @property
    def under_way(self) -> list[int]:
        """Numbers of the runs in batches that have not ended."""
        return [number for numbers in self._batches.values() for number in numbers]

    def stop(self) -> None:
        """Let no more run begin."""
        self._is_over = True

    def rows(self, numbers: Sequence[int]) -> Iterator[list[Row]]:
        """Compute the runs of these numbers, which increase, and yield the rows of each batch that has ended.

        A run without a row did not begin, if it is not `under_way`. Raises WorkersLostError, and
        KeyboardInterrupt if no worker can take the Ctrl-C.
        """
        begun = 0
        while begun < len(numbers) or self._batches:
            count = self._workers.count()
            if self._is_over or self._interrupt.should_stop():
                begun = len(numbers)
                for batch in self._workers.stop(self._batches, self._interrupt.presses):
                    del self._batches[batch]
                if not self._batches:
                    return
                if not count and self._interrupt.should_stop():
                    raise KeyboardInterrupt
            end = min(self._first_under_way(numbers, begun) + _MOST_AHEAD, len(numbers))
            while begun < end and len(self._batches) < count:
                size = self._batch_size(len(numbers) - begun, count)
                batch_numbers = tuple(numbers[begun : min(begun + size, end)])
                self._batches[self._workers.begin(batch_numbers)] = batch_numbers
                begun += len(batch_numbers)
            self._workers.wait(self._batches)
            for batch in [batch for batch in self._batches if batch.done()]:
                yield self._rows_of(batch)
                del self._batches[batch]

    def _first_under_way(self, numbers: Sequence[int], begun: int) -> int:
        """Return the position of the first run under way, or of the next one to begin."""
        return next((bisect_left(numbers, batch[0]) for batch in self._batches.values()), begun)

    def _batch_size(self, left: int, count: int) -> int:
        """Return the number of runs in the next batch, of those that are left for a number of workers."""
        if self._run_s is None:
            return 1
        shortest, longest = (batch_s / self._run_s for batch_s in self._workers.batch_s)
        return max(1, round(min(max(left / count, shortest), longest)))

    def _rows_of(self, batch: Batch) -> list[Row]:
        """Return the rows of a batch that has ended."""
        try:
            rows = batch.result()
        except CancelledError:
            raise self._workers.lost() from None
        except Exception as error:  # of its process, or of another executor
            rows = [Row(number, MISTAKE, death=str(error)) for number in self._batches[batch]]
        if rows:
            self._run_s = max(sum(row.wall_s for row in rows) / len(rows), 1e-6)
        if not all(row.lets_others_begin for row in rows):
            self.stop()
        return rows
