"""Tables of HTML for notebooks."""

from collections.abc import Collection, Iterable, Sequence
from html import escape

MOST_ROWS = 60
"""Rows of a table. Further rows are counted only."""

_CAPTION = "text-align: left; white-space: nowrap"
"""Otherwise the caption is as narrow as the table."""


def html_table(
    caption: str,
    headings: Sequence[str],
    rows: Iterable[Sequence[object]],
    in_caption: Collection[str] = (),
) -> str:
    """Return a table with a row for each of `rows`, at most `MOST_ROWS`, and the number of others.

    Columns with a heading of `in_caption` become a part of the caption if all rows have the same value.
    """
    rows = list(rows)
    same = [
        column
        for column, heading in enumerate(headings)
        if heading in in_caption and len({row[column] for row in rows}) == 1
    ]
    shown = [column for column in range(len(headings)) if column not in same]
    caption = ", ".join([caption, *(f"{headings[column]} {rows[0][column]}" for column in same)])
    lines = [f"<table><caption style='{_CAPTION}'>{escape(caption)}</caption>"]
    if rows:
        lines.append(_row("th", [headings[column] for column in shown]))
    lines += [_row("td", [row[column] for column in shown]) for row in rows[:MOST_ROWS]]
    lines.append("</table>")
    if len(rows) > MOST_ROWS:
        lines.append(f"<p>and {len(rows) - MOST_ROWS:,} more rows</p>")
    return "\n".join(lines)


def _row(tag: str, cells: Iterable[object]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(str(cell))}</{tag}>' for cell in cells)}</tr>"
