"""Where reports for people are printed."""

import os
import sys
from typing import TextIO

from rich.console import Console

_NO_BOUND = 10_000
"""Columns. Tables take as many as they need."""


class _Console(Console):
    def on_broken_pipe(self) -> None:
        """Raise the BrokenPipeError, which the command deals with. Rich would exit."""
        raise


def console(output: TextIO | None = None) -> Console:
    """Return a console for `output`, by default standard output.

    A terminal has its width, and COLUMNS says one. A file or a pipe has none: what reads it, such as grep,
    gets each row of a table in one line, and nothing is cut off.
    """
    target = sys.stdout if output is None else output
    has_width = target.isatty() or "COLUMNS" in os.environ
    return _Console(
        file=target, width=None if has_width else _NO_BOUND, markup=False, emoji=False, highlight=False
    )
