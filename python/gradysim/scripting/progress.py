"""Progress bar of `gradysim.run`: of HTML in a notebook, of rich in a terminal."""

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from html import escape
from time import monotonic
from typing import Any

from gradysim.cli.progress import RunProgress

_EVERY_S = 0.2
"""Wall time between two drawings."""


@contextmanager
def progress_bar(title: str, unit: str) -> Iterator[Callable[[float, float], None]]:
    """Show a bar, which the yielded function moves, such as to 3 of 20 runs.

    A notebook keeps the bar below its cell. A terminal shows it until the end of the `with` block. There is
    no bar if standard error is something else.
    """
    shell = _notebook()
    if shell is not None:
        yield _html_bar(title, unit)
    elif sys.stderr.isatty():
        with _rich_bar(title, unit) as update:
            yield update
    else:
        yield lambda done, total: None


def _notebook() -> Any:
    """Return the shell of the notebook that executes this; None without one."""
    ipython: Any = sys.modules.get("IPython")  # imported if this is a notebook
    shell = None if ipython is None else ipython.get_ipython()
    return shell if hasattr(shell, "kernel") else None


def _html_bar(title: str, unit: str) -> Callable[[float, float], None]:
    from importlib import import_module

    display: Any = import_module("IPython.display")
    handle: Any = None
    drawn_s = 0.0

    def update(done: float, total: float) -> None:
        nonlocal handle, drawn_s
        now_s = monotonic()
        if handle is not None and now_s - drawn_s < _EVERY_S and done < total:
            return
        drawn_s = now_s
        html = display.HTML(
            f'<div>{escape(title)} <progress value="{done:g}" max="{total:g}"></progress>'
            f" {done:,.9g} of {total:,.9g} {unit}</div>"
        )
        if handle is None:
            handle = display.display(html, display_id=True)
        else:
            handle.update(html)

    return update


@contextmanager
def _rich_bar(title: str, unit: str) -> Iterator[Callable[[float, float], None]]:
    from rich.console import Console

    with ExitStack() as at_end:
        bar: RunProgress | None = None

        def update(done: float, total: float) -> None:
            nonlocal bar
            if bar is None:
                bar = at_end.enter_context(RunProgress(Console(stderr=True), title, total, unit))
            bar.update(done)

        yield update
