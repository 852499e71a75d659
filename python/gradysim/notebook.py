"""What notebooks show of scenarios and results: tables, and the pages of replays."""

from collections.abc import Collection, Iterable, Sequence
from html import escape

MOST_ROWS = 60
"""Rows of a table. Further rows are counted only."""

MOST_COLUMNS = 60
"""Columns of a table. Further columns are counted only."""

_LONGEST_CELL = 200
"""Letters of a cell that are shown."""

_CAPTION = "text-align: left; white-space: nowrap"
"""Otherwise the caption is as narrow as the table."""

HEIGHT_PX = 640
"""Of a replay."""


class ReplayView:
    """The page of a replay, which a notebook shows as a frame. The notebook then contains the whole page."""

    def __init__(self, page: str, height_px: int) -> None:
        """`page` is the text of an HTML file of `gradysim run --replay`."""
        self._page = page
        self._height_px = height_px

    def _repr_html_(self) -> str:
        return (
            f'<iframe title="replay" width="100%" height="{self._height_px}" sandbox="allow-scripts"'
            f' style="border: 0" srcdoc="{escape(self._page)}"></iframe>'
        )


def html_table(
    caption: str,
    headings: Sequence[str],
    rows: Iterable[Sequence[object]],
    in_caption: Collection[str] = (),
) -> str:
    """Return a table with a row for each of `rows`, at most `MOST_ROWS`, and the number of others.

    It has at most `MOST_COLUMNS`, because protocols may track any number of variables. Columns with a
    heading of `in_caption` become a part of the caption if all rows have the same value.
    """
    rows = list(rows)
    same = [
        column
        for column, heading in enumerate(headings)
        if heading in in_caption and len({row[column] for row in rows}) == 1
    ]
    different = [column for column in range(len(headings)) if column not in same]
    shown = different[:MOST_COLUMNS]
    caption = ", ".join([caption, *(f"{headings[column]} {rows[0][column]}" for column in same)])
    lines = [f"<table><caption style='{_CAPTION}'>{escape(caption)}</caption>"]
    if rows:
        lines.append(_row("th", [headings[column] for column in shown]))
    lines += [_row("td", [row[column] for column in shown]) for row in rows[:MOST_ROWS]]
    lines.append("</table>")
    if len(rows) > MOST_ROWS:
        lines.append(f"<p>and {len(rows) - MOST_ROWS:,} more rows</p>")
    if len(different) > MOST_COLUMNS:
        lines.append(f"<p>and {len(different) - MOST_COLUMNS:,} more columns</p>")
    return "\n".join(lines)


def _row(tag: str, cells: Iterable[object]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(_shortened(str(cell)))}</{tag}>' for cell in cells)}</tr>"


def _shortened(text: str) -> str:
    return text if len(text) <= _LONGEST_CELL else f"{text[:_LONGEST_CELL]}…"
