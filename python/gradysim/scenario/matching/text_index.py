"""Many texts, such as the paths of all parameters: a pattern is tried with those alone that it may match."""

from collections.abc import Iterable, Iterator

from gradysim.scenario.matching.landmarks import Names, Places, landmarks, names_at
from gradysim.scenario.patterns import Pattern


class TextIndex:
    """Texts, each with its names between dots."""

    def __init__(self, texts: Iterable[str]) -> None:
        """Take them; they stay as they are."""
        self._texts = dict.fromkeys(texts)
        self._by_places: dict[Places, dict[Names, list[str]]] = {}
        self._has_match: dict[str, bool] = {}

    def __iter__(self) -> Iterator[str]:
        return iter(self._texts)

    def has_match(self, pattern: Pattern) -> bool:
        """Whether the pattern matches one of them."""
        if pattern.literal is not None:
            return pattern.literal in self._texts
        known = self._has_match.get(pattern.text)
        if known is None:
            known = self._has_match[pattern.text] = any(True for _ in self.matches(pattern))
        return known

    def matches(self, pattern: Pattern) -> Iterator[str]:
        """Yield those that the pattern matches, in their order."""
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
