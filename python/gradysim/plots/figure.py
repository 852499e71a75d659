"""Style of figures, and the three files of a figure: the picture, its numbers and their origin."""

import csv
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import gradysim
from gradysim.plots.numbers import Curve, Numbers
from gradysim.results.durable import replacing
from gradysim.results.files import hash_of_run_file
from gradysim.results.run_summary import RunSummary
from gradysim.scenario.errors import ConfigError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
"""Palette of M. Okabe and K. Ito for color-blind readers, without yellow.

Source: https://jfly.uni-koeln.de/color/, 2008.
"""
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
LINES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 3)), (0, (8, 2)))

STYLE: dict[Any, Any] = {
    "font.size": 8,
    "legend.fontsize": 7,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 6,
    "axes.titlecolor": "#555555",
    "lines.linewidth": 1.1,
    "lines.markersize": 3.5,
    "errorbar.capsize": 2,
    "legend.frameon": False,
    "hatch.linewidth": 0.5,
    "savefig.dpi": 300,
    "pdf.fonttype": 42,  # TrueType: journals refuse Type 3
    "svg.hashsalt": "gradysim",  # the same file for the same numbers
}
"""Settings of matplotlib for figures of a paper: `with matplotlib.rc_context(STYLE): ...`."""

WIDTHS_IN = {1: 3.5, 2: 7.16}
"""Width of a figure in inches, by the number of columns that it takes on a page of IEEE."""
HEIGHT_IN = 2.4

_MOST_INSIDE = 4
"""Largest number of entries of a legend inside the axes. A longer legend is next to them."""

SUFFIXES = (".pdf", ".png", ".svg")


def styles_of(curves: Sequence[Curve]) -> list[dict[str, Any]]:
    """Return color, marker and line style of each curve.

    If curves differ in several variables, colors are for the first one, markers and lines for the others.
    """
    keys = [tuple(curve.values.values()) for curve in curves]
    firsts = list(dict.fromkeys(key[:1] for key in keys))
    others = list(dict.fromkeys(key[1:] for key in keys))
    styles = []
    for index, key in enumerate(keys):
        color, line = (firsts.index(key[:1]), others.index(key[1:])) if len(others) > 1 else (index, index)
        line += color // len(COLORS)  # another combination in each round
        styles.append(
            {
                "color": COLORS[color % len(COLORS)],
                "marker": MARKERS[line % len(MARKERS)],
                "linestyle": LINES[line % len(LINES)],
            }
        )
    return styles


def new_figure(columns: int = 1) -> "Figure":
    """Return an empty figure of this style, which notebooks show. Raises ImportError without matplotlib."""
    try:
        import matplotlib.figure  # noqa: F401
    except ImportError as error:
        raise ImportError(
            "a figure needs matplotlib: pip install matplotlib (the extra `plot` of gradysim)"
        ) from error
    from gradysim.plots.shown_figure import ShownFigure

    return ShownFigure(figsize=(WIDTHS_IN[columns], HEIGHT_IN), layout="constrained")


def set_texts(axes: "Axes", numbers: Numbers) -> None:
    """Write labels, categories, caption and legend."""
    axes.set_xlabel(numbers.x_label)
    axes.set_ylabel(numbers.y_label)
    axes.set_title(numbers.caption, loc="right")
    if numbers.categories:
        axes.set_xticks(range(len(numbers.categories)), list(numbers.categories))
    handles, _ = axes.get_legend_handles_labels()
    if len(handles) > _MOST_INSIDE:
        axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    elif len(handles) > 1:
        axes.legend()


def check_file(path: Path, runs: Sequence[RunSummary]) -> None:
    """Check the name of a picture before it is drawn. Raises ConfigError."""
    if path.suffix.lower() not in SUFFIXES:
        problem = f"`{path.suffix}` is not a format" if path.suffix else "its name does not end in a format"
        raise ConfigError(f"{path}: {problem}", expected=", ".join(SUFFIXES))
    results = {run.file.resolve() for run in runs}
    for file in (path.with_suffix(".csv"), path.with_suffix(".json")):
        if file.resolve() in results:
            raise ConfigError(
                f"{path}: {file} would replace the result of a run", expected="another name for the figure"
            )


def write_files(
    figure: "Figure", path: Path, numbers: Numbers, runs: Sequence[RunSummary], origin: Mapping[str, object]
) -> tuple[Path, Path, Path]:
    """Write FILE.pdf, FILE.csv with its numbers and FILE.json with their origin, and return the paths.

    `origin` has the arguments. The JSON file adds the version and the runs with hashes of their files.
    Missing directories are created. Raises OSError, which names the file.
    """
    table, provenance = path.with_suffix(".csv"), path.with_suffix(".json")
    told = [
        {
            "file": str(run.file),
            "hash": hash_of_run_file(run.file),
            "config": run.config,
            "mode": run.mode,
            "run": run.run,
            "seed": run.seed,
            "settings_hash": run.settings_hash,
        }
        for run in runs
    ]
    content = {"figure": path.name, "numbers": table.name, "gradysim": gradysim.__version__, **origin}
    suffix = path.suffix.lower()
    with replacing(path) as unfinished:
        dates = {_DATE[suffix]: None} if suffix in _DATE else None
        figure.savefig(unfinished, format=suffix[1:], metadata=dates)
    with replacing(table) as unfinished, unfinished.open("w", encoding="utf-8", newline="") as output:
        csv.writer(output, lineterminator="\n").writerows(rows_of(numbers))
    with replacing(provenance) as unfinished:
        text = json.dumps(content | {"runs": told}, indent=2) + "\n"
        unfinished.write_text(text, encoding="utf-8")
    return path, table, provenance


_DATE = {".pdf": "CreationDate", ".svg": "Date"}
"""Metadata that would differ between two runs."""


def rows_of(numbers: Numbers) -> list[list[object]]:
    """Return a header, and a row for each drawn number."""
    headings = list(
        dict.fromkeys(name for curve in numbers.curves for name in (*curve.values, *curve.columns))
    )
    rows: list[list[object]] = [list(headings)]
    for curve in numbers.curves:
        for cells in zip(*curve.columns.values(), strict=True):
            row = {**curve.values, **dict(zip(curve.columns, cells, strict=True))}
            rows.append(["" if row.get(name) is None else row.get(name) for name in headings])
    return rows
