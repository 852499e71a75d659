"""A run cut into slices, so that it can report how far it is and be stopped.

Both modes run this way: the simulator executes some events, control comes back here, and the next slice
is made longer or shorter so that one takes about `SLICE_S` of wall time.
"""

from collections.abc import Callable
from time import perf_counter

SLICE_S = 0.05
"""Wall time that a slice should take, in seconds."""

REPORT_INTERVAL_S = 0.1
"""Wall time between two calls of `progress`, in seconds."""

FIRST_SLICE = 64
"""Events of the first slice: few, as nothing is known yet of what one costs."""

MOST_EVENTS = 1 << 20
"""Events of a slice at most. The slices of a run that waits for the wall clock are short, however many events
they may have: their number would grow for ever."""


def run_in_slices(
    advance: Callable[[int], bool],
    now: Callable[[], float],
    progress: Callable[[float], None] | None = None,
    should_stop: Callable[[], bool] | None = None,
) -> bool:
    """Call `advance(max_events)` until it returns True, which says that the run is complete.

    `progress(now())` is called about ten times a second, and once at the end. `should_stop()` is asked
    between slices. Returns whether the run was completed; False when `should_stop` ended it.
    """
    max_events = FIRST_SLICE
    last_report = perf_counter()
    complete = stopped = False
    while not complete and not stopped:
        start = perf_counter()
        complete = advance(max_events)
        end = perf_counter()
        max_events = next_slice(max_events, end - start)
        stopped = not complete and should_stop is not None and should_stop()
        if progress is not None and (complete or stopped or end - last_report >= REPORT_INTERVAL_S):
            last_report = end
            progress(now())
    return complete


def next_slice(max_events: int, took_s: float) -> int:
    """Return the number of events of the next slice: at most four times as many, at least a quarter."""
    factor = min(4.0, max(0.25, SLICE_S / took_s)) if took_s > 0 else 4.0
    return min(MOST_EVENTS, max(1, int(max_events * factor)))
