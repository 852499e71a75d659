"""Console for reports."""

import os
import sys
from typing import TextIO

from rich.console import Console

_NO_BOUND = 10_000
"""Width in columns. Tables are as wide as they need to be."""


class _Console(Console):
    def on_broken_pipe(self) -> None:
        """Raise the BrokenPipeError, which `main` handles. Rich would exit."""
        raise


def console(output: TextIO | None = None) -> Console:
    """Return a console for `output`, by default standard output.

    A terminal has a width, or COLUMNS sets one. A file or a pipe does not: each row of a table is one line
    for programs such as grep, and nothing is truncated.
    """
    target = sys.stdout if output is None else output
    has_width = target.isatty() or "COLUMNS" in os.environ
    return _Console(
        file=target, width=None if has_width else _NO_BOUND, markup=False, emoji=False, highlight=False
    )
