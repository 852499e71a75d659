"""Compares the blocks of output on a page with what its commands print; `make pages` rewrites them."""

import os
import re
import textwrap
from collections.abc import Iterator
from difflib import SequenceMatcher, unified_diff
from pathlib import Path

REWRITE = bool(os.environ.get("REWRITE_PAGES"))
"""Whether blocks that differ are rewritten, instead of failing the test."""

GAP = "…"
"""A line of a block that stands for any lines of the output."""

CHANGING = re.compile(r"[\d.]+ s(?: \([\d,]+ x real time\))?|result hash \w+|in [\d.]+s")
"""Processor times, and hashes that change with the engine."""

_COLUMNS = 120


def check_block(
    page: Path,
    printed: str,
    number: int,
    *,
    part: bool = False,
    changing: bool = False,
    terminal: bool = False,
    language: str = "text",
    rewrite: bool = REWRITE,
) -> None:
    """Compare the block of the page with this number with the printed lines.

    Blanks at the ends of lines do not count. A block with `part` shows lines in a row. With `changing`,
    processor times and hashes may differ. With `terminal`, long lines go on in the next one.
    """
    text = page.read_text(encoding="utf-8")
    block = list(re.finditer(rf"^```{language}\n(.*?)^```", text, re.MULTILINE | re.DOTALL))[number]
    shown, lines = lines_of(block[1]), lines_of(printed)
    if terminal:
        lines = [
            part for line in lines for part in textwrap.wrap(line, _COLUMNS, break_on_hyphens=False) or [""]
        ]
    if part:
        shown = [GAP, *shown, GAP]
    corrected = correct(shown, lines, changing)
    if part:
        del corrected[0], corrected[-1]
        shown = shown[1:-1]
    if plain(shown, changing) == plain(corrected, changing):
        return
    if rewrite:
        new = "".join(f"{line}\n" for line in corrected)
        page.write_text(text[: block.start(1)] + new + text[block.end(1) :], encoding="utf-8")
    else:
        difference = "\n".join(unified_diff(shown, corrected, "shown", "printed", lineterm=""))
        raise AssertionError(f"{page.name}: the output differs. `make pages` rewrites it.\n{difference}")


def lines_of(text: str) -> list[str]:
    """Return the lines without blanks at their ends, and without empty lines at both ends."""
    return [line.rstrip() for line in text.strip("\n").splitlines()]


def plain(lines: list[str], changing: bool) -> list[str]:
    """Return what must be equal of the lines."""
    return [CHANGING.sub("", line).rstrip() if changing else line for line in lines]


def correct(shown: list[str], printed: list[str], changing: bool) -> list[str]:
    """Return what the block should be. Lines that are right stay as they are shown."""
    if GAP not in shown:
        return merge(shown, printed, changing)
    corrected: list[str] = []
    start = 0
    for piece in pieces(shown):
        if piece == [GAP]:
            corrected += piece
            continue
        start, end = nearest(plain(piece, changing), plain(printed, changing), start)
        corrected += merge(piece, printed[start:end], changing)
        start = end
    return corrected


def pieces(shown: list[str]) -> Iterator[list[str]]:
    """Split the lines at the gaps, which are pieces of their own."""
    piece: list[str] = []
    for line in shown:
        if line == GAP:
            if piece:
                yield piece
            yield [GAP]
            piece = []
        else:
            piece.append(line)
    if piece:
        yield piece


def nearest(piece: list[str], printed: list[str], start: int) -> tuple[int, int]:
    """Return the range of as many printed lines, from `start` on, that resembles the piece most."""

    def similarity(first: int) -> float:
        pairs = zip(piece, printed[first : first + len(piece)], strict=False)
        return sum(SequenceMatcher(None, a, b, autojunk=False).ratio() if a != b else 2 for a, b in pairs)

    starts = range(start, max(len(printed) - len(piece), start) + 1)
    equal = (first for first in starts if printed[first : first + len(piece)] == piece)
    first = next(equal, None)
    if first is None:
        first = max(starts, key=similarity)
    return first, first + len(piece)


def merge(shown: list[str], printed: list[str], changing: bool) -> list[str]:
    """Return the printed lines, but those that agree as they are shown."""
    merged: list[str] = []
    old, new = plain(shown, changing), plain(printed, changing)
    for tag, i, i_end, j, j_end in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        merged += shown[i:i_end] if tag == "equal" else printed[j:j_end]
    return merged
