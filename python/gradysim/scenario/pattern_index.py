"""Indices of many patterns and many paths, so that few pairs of them are compared.

A landmark is a name that everything that matches a pattern has at a certain place. Places count from the
first name, and from the last name after a `**`, which may be any number of names.
`**.uavs[3].wlan[*].power` has `uavs[3]` at -3, a name that begins with `wlan[` at -2, and `power` at -1.
"""

from collections.abc import Iterable, Iterator, Sequence
from operator import itemgetter
from typing import Generic, NamedTuple, TypeVar

from gradysim.scenario.patterns import Pattern, Token


class Place(NamedTuple):
    """The position of a name, and whether only the part up to the bracket is certain."""

    position: int
    up_to_bracket: bool


Places = tuple[Place, ...]
Names = tuple[str, ...]


def landmarks(pattern: Pattern) -> tuple[Places, Names]:
    """Return the places where a name is certain, and these names."""
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
    """Return the names of a path, split at its dots, at these places; None if it has too few names."""
    try:
        return tuple(
            [
                text[position][: text[position].find("[") + 1] if up_to_bracket else text[position]
                for position, up_to_bracket in places
            ]
        )
    except IndexError:
        return None


Item = TypeVar("Item")


class PatternIndex(Generic[Item]):
    """Items, each with a pattern. Several may have the same pattern."""

    def __init__(self) -> None:
        """Start empty."""
        self._count = 0
        self._literal: dict[str, list[tuple[int, Item]]] = {}
        self._by_places: dict[Places, dict[Names, dict[str, tuple[Pattern, list[tuple[int, Item]]]]]] = {}

    def add(self, pattern: Pattern, item: Item) -> None:
        """Add an item."""
        if pattern.literal is not None:
            alike = self._literal.setdefault(pattern.literal, [])
        else:
            places, names = landmarks(pattern)
            by_text = self._by_places.setdefault(places, {}).setdefault(names, {})
            alike = by_text.setdefault(pattern.text, (pattern, []))[1]
        alike.append((self._count, item))
        self._count += 1

    def matching(self, text: str) -> list[Item]:
        """Return the items whose patterns match, in the order in which they were added."""
        found = list(self._literal.get(text, ()))
        parts = text.split(".")
        for places, by_names in self._by_places.items():
            names = names_at(places, parts)
            for pattern, items in by_names.get(names, {}).values() if names is not None else ():
                if pattern.matches(text):
                    found += items
        found.sort(key=itemgetter(0))
        return [item for _, item in found]


class TextIndex:
    """Paths such as `mobility.speed`."""

    def __init__(self, texts: Iterable[str]) -> None:
        """Index these paths."""
        self._texts = dict.fromkeys(texts)
        self._by_places: dict[Places, dict[Names, list[str]]] = {}
        self._has_match: dict[str, bool] = {}

    def __iter__(self) -> Iterator[str]:
        return iter(self._texts)

    def has_match(self, pattern: Pattern) -> bool:
        """Return whether the pattern matches one of the paths."""
        if pattern.literal is not None:
            return pattern.literal in self._texts
        known = self._has_match.get(pattern.text)
        if known is None:
            known = self._has_match[pattern.text] = any(True for _ in self.matches(pattern))
        return known

    def matches(self, pattern: Pattern) -> Iterator[str]:
        """Yield the paths that the pattern matches, in their order."""
        places, names = landmarks(pattern)
        if places not in self._by_places:
            self._by_places[places] = self._at(places)
        return filter(pattern.matches, self._by_places[places].get(names, ()))

    def _at(self, places: Places) -> dict[Names, list[str]]:
        by_names: dict[Names, list[str]] = {}
        for text in self._texts:
            names = names_at(places, text.split("."))
            if names is not None:
                by_names.setdefault(names, []).append(text)
        return by_names
