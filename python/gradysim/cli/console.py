"""Console for reports, and how they print intervals."""

import math
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


def interval_text(
    mean: float | None, low: float | None, high: float | None, digits: str, plus_minus: str = ""
) -> str:
    """Return half the width of an interval after `plus_minus`, or both ends if the mean is not in the middle.

    `digits` is a format specification. A single number has no interval: "".
    """
    if mean is None or low is None or high is None:
        return ""
    # Three digits do not show a difference of 0.5 %, which may be the rounding error of the mean.
    if math.isclose(mean - low, high - mean, rel_tol=0.005, abs_tol=1e-9 * abs(mean)):
        return f"{plus_minus}{high / 2 - low / 2:{digits}}"
    return f"[{low:{digits}}, {high:{digits}}]"
