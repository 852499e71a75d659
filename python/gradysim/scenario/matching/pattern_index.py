"""Many patterns, of which those that match a text are found without trying each."""

from operator import itemgetter
from typing import Generic, TypeVar

from gradysim.scenario.matching.landmarks import Names, Places, landmarks, names_at
from gradysim.scenario.patterns import Pattern

Item = TypeVar("Item")


class PatternIndex(Generic[Item]):
    """Items by a pattern for each, of which several may be the same."""

    def __init__(self) -> None:
        """Without any."""
        self._count = 0
        self._literal: dict[str, list[tuple[int, Item]]] = {}
        self._by_places: dict[Places, dict[Names, dict[str, tuple[Pattern, list[tuple[int, Item]]]]]] = {}

    def add(self, pattern: Pattern, item: Item) -> None:
        """Take one more."""
        if pattern.literal is not None:
            alike = self._literal.setdefault(pattern.literal, [])
        else:
            places, names = landmarks(pattern)
            by_text = self._by_places.setdefault(places, {}).setdefault(names, {})
            alike = by_text.setdefault(pattern.text, (pattern, []))[1]
        alike.append((self._count, item))
        self._count += 1

    def matching(self, text: str) -> list[Item]:
        """Return the items whose patterns match, in the order in which they came."""
        found = list(self._literal.get(text, ()))
        parts = text.split(".")
        for places, by_names in self._by_places.items():
            names = names_at(places, parts)
            for pattern, items in by_names.get(names, {}).values() if names is not None else ():
                if pattern.matches(text):
                    found += items
        found.sort(key=itemgetter(0))
        return [item for _, item in found]
