"""Lines that lines above them deprive of any effect: `**.speed = ...`, then `*.uavs[0].mobility.speed = ...`.

Of two lines that fit, the first one is in force, as in OMNeT++, which takes the second one without a word;
but who writes a special line below a general one mostly believes that it counts. Of lines in different
sections or files, the one that gives way is there to be overridden, and nothing is said.
"""

from collections.abc import Iterator
from pathlib import Path

from gradysim.config.lookup import is_ignored, is_option
from gradysim.config.pattern import Pattern, compile_pattern
from gradysim.config.reader import Entry, Section, read_ini
from gradysim.config.sections import search_order

_NO_DOT = "\0\0\0"
"""Stands for what a wildcard within one name may be: `*` matches it, a range and a name do not."""

_ANYTHING = ".".join([_NO_DOT] * 10)
"""Stands for what `**` may be; longer than any path, so that no row of `*` matches it."""


def shadowed_lines(file: Path, config: str) -> list[str]:
    """Return one line of text for each, "FILE:LINE: warning: ...", of a configuration that can be loaded."""
    return [text for section in search_order(read_ini(file), config) for text in _of_section(section)]


def _of_section(section: Section) -> Iterator[str]:
    same_key: dict[str, Entry] = {}
    general: list[tuple[Pattern, Entry]] = []
    for entry in section.entries:
        if is_ignored(entry):
            continue
        pattern = compile_pattern(entry.key)
        above = same_key.setdefault(entry.key, entry)
        if above is entry and not is_option(entry):
            above = _first_that_covers(pattern, general) or entry
            if _is_general(pattern):
                general.append((pattern, entry))
        if above.source.file == entry.source.file and above.text != entry.text:
            yield (
                f"{entry.source}: warning: `{entry.key}` has no effect: line {above.source.line},"
                f" `{above.key}`, fits as well and comes first; expected the special line above the"
                " general one"
            )


def _is_general(pattern: Pattern) -> bool:
    """Whether more may match than one parameter of one node, in a network of whatever name."""
    parts = pattern.split()
    return parts is None or any(part.literal is None for part in parts[1:])


def _first_that_covers(pattern: Pattern, above: list[tuple[Pattern, Entry]]) -> Entry | None:
    """The first of the lines above that fits wherever `pattern` does."""
    path = "".join(
        token.literal or (_ANYTHING if token.spans_dots else _any_of(token.text)) for token in pattern.tokens
    )
    return next((entry for other, entry in above if other.matches(path)), None)


def _any_of(wildcard: str) -> str:
    """What a wildcard within one name is taken for; a range keeps its brackets: `[0..3]` is within `[*]`."""
    return f"[{_NO_DOT}]" if wildcard.startswith("[") else _NO_DOT
