"""The current folder, from which relative names are seen: protocols may go to another one."""

import contextlib
import os
from collections.abc import Iterator


@contextlib.contextmanager
def back_afterwards() -> Iterator[None]:
    """Inside, code of the user may call os.chdir; afterwards the process is where it was.

    So --result-dir and the files of a scenario mean the same before and after, and in each of many runs.
    It finds back also to a folder that has another name by then.
    """
    if not hasattr(os, "fchdir"):
        yield
        return
    folder = os.open(".", getattr(os, "O_PATH", os.O_RDONLY))
    try:
        yield
    finally:
        os.fchdir(folder)
        os.close(folder)
