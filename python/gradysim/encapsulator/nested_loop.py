"""Run an asyncio loop inside another one, such as that of a notebook."""

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def outer_loop_stands() -> Iterator[None]:
    """Suspend the running asyncio loop of this thread, so that another one can run."""
    outer = asyncio._get_running_loop()
    swap_task = None if outer is None else getattr(asyncio.tasks, "_swap_current_task", None)
    # Available from Python 3.12 on, needed from 3.14 on: a thread has one task at a time.
    task = None if swap_task is None else swap_task(outer, None)
    asyncio._set_running_loop(None)
    try:
        yield
    finally:
        asyncio._set_running_loop(outer)
        if swap_task is not None:
            swap_task(outer, task)
