"""Lines that lines above them deprive of any effect: `**.speed = ...`, then `*.uavs[0].mobility.speed = ...`.

Of two lines that fit, the first one is in force, as in OMNeT++, which takes the second one without a word;
but who writes a special line below a general one mostly believes that it counts. Of lines in different
sections or files, the one that gives way is there to be overridden, and nothing is said.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from gradysim.scenario.file.reader import Entry, Section
from gradysim.scenario.matching.lookup import is_ignored, is_option
from gradysim.scenario.matching.pattern_index import PatternIndex
from gradysim.scenario.value.pattern import Pattern, compile_pattern

_NO_DOT = "\0\0\0"
"""Stands for what a wildcard within one name may be: `*` matches it, a range and a name do not."""

_ANYTHING = ".".join([_NO_DOT] * 10)
"""Stands for what `**` may be; longer than any path, so that no row of `*` matches it."""

_INSTEAD: dict[str, tuple[str, ...]] = {
    "channelNumber": ("centerFrequency",),
    "centerFrequency": ("channelNumber",),
    "protocol.class": ("protocol.typename",),
    "protocol.typename": ("protocol.class",),
} | {
    end: others
    for axis in "XYZ"
    for end, others in {
        f"initial{axis}": (f"lineStart{axis}", f"lineStep{axis}", f"separation{axis}"),
        f"lineStart{axis}": (f"initial{axis}", f"separation{axis}"),
        f"lineStep{axis}": (f"initial{axis}", f"separation{axis}"),
        f"separation{axis}": (f"initial{axis}", f"lineStart{axis}", f"lineStep{axis}"),
    }.items()
}
"""By the end of a key those of other keys that set the same."""

_INSTEAD_WITH_POWERS = _INSTEAD | {
    "transmitter.power": ("transmitter.communicationRange",),
    "transmitter.communicationRange": ("transmitter.power",),
    "communicationRange": ("transmitter.power",),
}
"""The same where a range stands for the power that it takes."""

_NONE_BY_DEFAULT = ("transmitter.power", "communicationRange", "protocol.class", "protocol.typename")
"""Ends of keys whose default says nothing about the other."""

_COUNT = re.compile(r"(.*\.)(?:num([A-Z])(\w*)|([a-z])(\w*)\.count)", re.ASCII)
"""`*.numUavs` and `*.uavs.count`."""


def shadowed_lines(sections: Iterable[Section], *, has_powers: bool = True) -> list[str]:
    """Return one line of text for each, "FILE:LINE: warning: ...", of sections that make a valid scenario.

    `has_powers` says whether its radio medium knows powers; on one that does not, a range is only a range.
    """
    instead = _INSTEAD_WITH_POWERS if has_powers else _INSTEAD
    return [text for section in sections for text in _of_section(section, instead)]


def line_that_says_it_instead(entry: Entry, before: Iterable[Entry]) -> Entry | None:
    """Return one of the lines before an entry that is in force wherever that fits, by whatever key.

    They may be of other sections and files. None if there is none.
    """
    lines = [line for line in before if not is_ignored(line)]
    same_key = {line.key: line for line in reversed(lines)}
    general: PatternIndex[Entry] = PatternIndex()
    for line in lines:
        if not is_option(line) and _is_general(pattern := compile_pattern(line.key)):
            general.add(pattern, line)
    return _deprived_by(entry, _instead_of(entry.key, _INSTEAD_WITH_POWERS), same_key, general)


def _of_section(section: Section, instead: Mapping[str, Sequence[str]]) -> Iterator[str]:
    same_key: dict[str, Entry] = {}
    general: PatternIndex[Entry] = PatternIndex()
    for entry in section.entries:
        if is_ignored(entry):
            continue
        others = _instead_of(entry.key, instead)
        above = _deprived_by(entry, others, same_key, general)
        if above is None:
            same_key.setdefault(entry.key, entry)
            pattern = compile_pattern(entry.key)
            if not is_option(entry) and _is_general(pattern):
                general.add(pattern, entry)
        elif above.source.file == entry.source.file:
            yield (
                f"{entry.source}: warning: `{entry.key}` has no effect: line {above.source.line},"
                f" `{above.key}`, {_why(entry, others, above)}"
            )


def _why(entry: Entry, others: Sequence[str], above: Entry) -> str:
    if above.key in (entry.key, *others):
        return "says the same thing and comes first; expected one of them"
    return "fits as well and comes first; expected the special line above the general one"


def _deprived_by(
    entry: Entry,
    others: Sequence[str],
    same_key: Mapping[str, Entry],
    general: PatternIndex[Entry],
) -> Entry | None:
    """The line above that is in force instead, wherever this one fits, and that says something else."""
    for key in (entry.key, *others):
        above = same_key.get(key) or _first_that_covers(compile_pattern(key), general)
        if above is None or (above.text == entry.text and (key == entry.key or _COUNT.fullmatch(key))):
            continue
        if key == entry.key or above.text != "default" or not key.endswith(_NONE_BY_DEFAULT):
            return above
    return None


def _instead_of(key: str, instead: Mapping[str, Sequence[str]]) -> list[str]:
    """Keys of which the first one is in force, as they say the same thing in other words."""
    if match := _COUNT.fullmatch(key):
        network, initial, rest, small_initial, others = match.groups()
        return [
            f"{network}{initial.lower()}{rest}.count"
            if initial
            else f"{network}num{small_initial.upper()}{others}"
        ]
    return [
        key.removesuffix(end) + other
        for end, others in instead.items()
        if key.endswith(f".{end}")
        for other in others
    ]


def _is_general(pattern: Pattern) -> bool:
    """Whether more may match than one parameter of one node, in a network of whatever name."""
    parts = pattern.split()
    return parts is None or any(part.literal is None for part in parts[1:])


def _first_that_covers(pattern: Pattern, above: PatternIndex[Entry]) -> Entry | None:
    """The first of the lines above that fits wherever `pattern` does."""
    path = "".join(
        token.literal or (_ANYTHING if token.spans_dots else _any_of(token.text)) for token in pattern.tokens
    )
    return next(iter(above.matching(path)), None)


def _any_of(wildcard: str) -> str:
    """What a wildcard within one name is taken for; a range keeps its brackets: `[0..3]` is within `[*]`."""
    return f"[{_NO_DOT}]" if wildcard.startswith("[") else _NO_DOT
