"""Process-wide state while a run is built or executed: Python's `random` and its garbage collector."""

import gc
import random
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def global_random_seeded(seed: int) -> Iterator[None]:
    """Seed the module `random` inside the block. Afterwards restore the state that the script had."""
    before = random.getstate()
    random.seed(seed)
    try:
        yield
    finally:
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
