"""What is certain of the texts that a pattern matches: which names they have at which places between dots.

A position is an index into the names: from the first on, and from the last on behind a `**`, which may be any
number of them. `**.uavs[3].wlan[*].power` has `uavs[3]` at -3, a name that begins with `wlan[` at -2, and
`power` at -1.
"""

from collections.abc import Sequence
from typing import NamedTuple

from gradysim.scenario.patterns import Pattern, Token


class Place(NamedTuple):
    """Where a name stands, and whether only its beginning is certain, up to the bracket."""

    position: int
    up_to_bracket: bool


Places = tuple[Place, ...]
Names = tuple[str, ...]


def landmarks(pattern: Pattern) -> tuple[Places, Names]:
    """The places where a name is certain, and these names."""
    parts: list[list[Token]] = [[]]
    for token in pattern.tokens:
        if token.literal == ".":
            parts.append([])
        else:
            parts[-1].append(token)
    uncertain = [index for index, part in enumerate(parts) if any(token.spans_dots for token in part)]
    from_first, from_last = (uncertain[0], uncertain[-1] + 1) if uncertain else (len(parts), len(parts))
    places, names = [], []
    for index in (*range(from_first), *range(from_last - len(parts), 0)):
        part = Pattern(tuple(parts[index]))
        beginning, bracket, _ = part.literal_prefix().partition("[")
        if part.literal is not None:
            places.append(Place(index, up_to_bracket=False))
            names.append(part.literal)
        elif bracket:
            places.append(Place(index, up_to_bracket=True))
            names.append(beginning + bracket)
    return tuple(places), tuple(names)


def names_at(places: Places, text: Sequence[str]) -> Names | None:
    """What a text, split at its dots, has at these places; None if it has fewer."""
    try:
        return tuple(
            [
                text[position][: text[position].find("[") + 1] if up_to_bracket else text[position]
                for position, up_to_bracket in places
            ]
        )
    except IndexError:
        return None
