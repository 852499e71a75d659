"""An asyncio loop within another one, such as that of a notebook, which stands meanwhile."""

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def outer_loop_stands() -> Iterator[None]:
    """While inside, another loop may run in this thread; what runs in the outer one does not know of it."""
    outer = asyncio._get_running_loop()
    swap_task = None if outer is None else getattr(asyncio.tasks, "_swap_current_task", None)
    # From Python 3.12 on there is that, from 3.14 on it is needed: a thread has one task at a time.
    task = None if swap_task is None else swap_task(outer, None)
    asyncio._set_running_loop(None)
    try:
        yield
    finally:
        asyncio._set_running_loop(outer)
        if swap_task is not None:
            swap_task(outer, task)
