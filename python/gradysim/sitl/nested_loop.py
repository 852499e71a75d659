"""An asyncio loop within another one, such as that of a notebook, which stands meanwhile."""

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def outer_loop_stands() -> Iterator[None]:
    """While inside, another loop may run in this thread; what runs in the outer one does not know of it."""
    outer = asyncio._get_running_loop()
    asyncio._set_running_loop(None)
    try:
        yield
    finally:
        asyncio._set_running_loop(outer)
