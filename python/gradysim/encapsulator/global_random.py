"""Python's own stream of random numbers, the module `random`, as protocols find it in a run.

It belongs to the script: a run borrows it, seeded, and gives it back as it was. A search that draws its next
candidate from it goes on where it was, whatever runs in between.
"""

import random
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def global_random_of(seed: int) -> Iterator[None]:
    """Inside, `random` follows from the seed of a run; afterwards it is as before."""
    before = random.getstate()
    random.seed(seed)
    try:
        yield
    finally:
        random.setstate(before)
