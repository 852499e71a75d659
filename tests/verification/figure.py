"""Common style of all pictures. Imported only for drawing: the tests do not need matplotlib."""

from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

mpl.use("agg")

OURS, INET, NS3, MODEL = "#1b6ca8", "#d1495b", "#2e933c", "#777777"
"""Colors: the same one for the same source in all pictures."""


def save(
    path: Path,
    title: str,
    *panels: Callable[[Axes], None],
    columns: int = 3,
    width: float = 4.5,
    height: float = 3.5,
) -> None:
    """Draw panels, `columns` in a row, and write them to `path`; the same data gives the same bytes.

    Width and height are those of a panel, in inches.
    """
    columns = min(columns, len(panels))
    lines = -(-len(panels) // columns)
    with mpl.rc_context({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False}):
        figure = Figure(figsize=(width * columns, height * lines + 0.3), dpi=100, layout="constrained")
        for axes, draw in zip(figure.subplots(lines, columns, squeeze=False).flat, panels, strict=True):
            draw(axes)
            axes.grid(alpha=0.25)
        figure.suptitle(title, fontsize=10, fontweight="bold")
        figure.savefig(path, metadata={"Software": None})
