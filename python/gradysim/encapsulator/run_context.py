"""Process-wide state while a run is built or executed: Python's `random` and its garbage collector."""

import gc
import random
from collections.abc import Iterator
from contextlib import contextmanager


class GlobalRandom:
    """The state of the module `random` for one run, which goes on where it was each time it is in use."""

    def __init__(self, seed: int) -> None:
        self._state = random.Random(seed).getstate()

    @contextmanager
    def in_use(self) -> Iterator[None]:
        """Give `random` the state of the run inside the block. Afterwards restore that of the script."""
        before = random.getstate()
        random.setstate(self._state)
        try:
            yield
        finally:
            self._state = random.getstate()
            random.setstate(before)


@contextmanager
def gc_paused() -> Iterator[None]:
    """Disable the garbage collector inside the block. Afterwards enable it if it was enabled.

    A run under construction has no garbage in cycles. With 10,000 nodes the search takes a seventh of the
    build time.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
