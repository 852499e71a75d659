r"""Patterns of keys, matched against full paths such as `Network.uavs[3].mobility.speed`.

| element | matches |
|---|---|
| `*`, `**` | any text without a dot, any text |
| `?` | one character that is not a dot |
| `{a-z}`, `{^a-z}` | one of the characters, one other character |
| `[3..5]`, `{3..5}` | a number of the range in brackets, without them; either end may be left open |
| `\x` | the character x itself |
"""

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from itertools import groupby
from operator import itemgetter
from typing import Generic, TypeVar

from gradysim.scenario.errors import BadValue

_NUMBER_RANGE = re.compile(r"(?:\[(\d*)\.\.(\d*)\])|(?:\{(\d*)\.\.(\d*)\})", re.ASCII)

_MOST_DIGITS = 18
"""Of the ends of a range. The regular expression grows with their square, and no node has such an index."""

LONGEST_PATTERN = 1000
"""Characters of a pattern."""

_STARS = ("*", "**")


@dataclass(frozen=True)
class Token:
    """One element of a pattern: its text, its regular expression, and its character if it is literal."""

    text: str
    regex: str
    literal: str | None = None
    spans_dots: bool = False


@dataclass(frozen=True, eq=False)
class Pattern:
    """A compiled pattern, or a part of one."""

    tokens: tuple[Token, ...]

    @cached_property
    def text(self) -> str:
        """The pattern as written."""
        return "".join(token.text for token in self.tokens)

    @cached_property
    def literal(self) -> str | None:
        """The only text that matches, or None if there may be several."""
        characters = [token.literal for token in self.tokens]
        return None if None in characters else "".join(character or "" for character in characters)

    @cached_property
    def _steps(self) -> list[str | re.Pattern[str]]:
        """What is matched one after the other: `*`, `**`, and an expression for all between two of these.

        A single wildcard is a part of one expression, which is ten times faster.
        """
        if sum(token.text in _STARS for token in self.tokens) < 2:
            return [_compiled("".join(token.regex for token in self.tokens) + r"\Z")]
        steps: list[str | re.Pattern[str]] = []
        for text, tokens in groupby(self.tokens, lambda token: token.text if token.text in _STARS else ""):
            steps.append(text or _compiled("".join(token.regex for token in tokens)))
        return steps

    @cached_property
    def tail(self) -> "Pattern | None":
        """The part after the last dot, or None if `**` makes it uncertain."""
        tokens: list[Token] = []
        for token in reversed(self.tokens):
            if token.literal == ".":
                break
            if token.spans_dots:
                return None
            tokens.insert(0, token)
        return Pattern(tuple(tokens))

    def matches(self, path: str) -> bool:
        """Return whether the whole of `path` matches.

        The time is proportional to the product of both lengths.
        """
        if self.literal is not None:  # compiling a regular expression takes longer than reading the line
            return path == self.literal
        return len(path) in _ends_of_matches(self._steps, path)

    def literal_prefix(self) -> str:
        """Common prefix of all matching paths."""
        characters: list[str] = []
        for token in self.tokens:
            if token.literal is None:
                return "".join(characters) + ("[" if token.text.startswith("[") else "")
            characters.append(token.literal)
        return "".join(characters)

    @cached_property
    def group(self) -> str | None:
        """What all that matches has before its bracket, `uavs` for `uavs[*]`; None if that may differ."""
        name, bracket, _ = self.literal_prefix().partition("[")
        return name if bracket else None

    @cached_property
    def below_anything(self) -> "tuple[Pattern, Pattern | None] | None":
        """`uavs[*]` and `mobility.speed` for `**.uavs[*].mobility.speed`, `speed` and None for `**.speed`.

        None for a pattern that does not begin so, or of which the first name may have dots.
        """
        if [token.text for token in self.tokens[:2]] != ["**", "."]:
            return None
        tokens = self.tokens[2:]
        dot = next((index for index, token in enumerate(tokens) if token.literal == "."), len(tokens))
        name, rest = tokens[:dot], tokens[dot + 1 :]
        if any(token.spans_dots for token in name):
            return None
        return Pattern(name), Pattern(rest) if dot < len(tokens) else None

    @cached_property
    def below_any_name(self) -> "tuple[Pattern, Pattern] | None":
        """`Net` and `**.speed` for `Net.**.speed`; None for a pattern of another form."""
        dot = next((index for index, token in enumerate(self.tokens) if token.literal == "."), 0)
        name, rest = self.tokens[:dot], self.tokens[dot + 1 :]
        if [token.text for token in rest[:2]] != ["**", "."] or any(token.spans_dots for token in name):
            return None
        return Pattern(name), Pattern(rest)

    @cached_property
    def landmark(self) -> str:
        """A name, or its part up to the bracket, that all matching paths have; "" if none is certain.

        `uavs[3]` for `**.uavs[3].wlan[*].power`, `wlan[` for `**.wlan[*].power`, `power` for `**.power`.
        """
        parts: list[list[Token]] = [[]]
        for token in self.tokens:
            if token.literal == ".":
                parts.append([])
            else:
                parts[-1].append(token)
        landmark = ""
        for pattern in map(Pattern, map(tuple, parts)):
            if pattern.group is not None:
                return pattern.literal or f"{pattern.group}["
            landmark = pattern.literal or landmark
        return landmark

    def split(self) -> "list[Pattern] | None":
        """The parts between the first two dots and after them, or None if `**` makes those dots uncertain.

        `*.uavs[*].mobility.speed` gives `*`, `uavs[*]` and `mobility.speed`; `*.numUavs` gives two.
        """
        parts: list[list[Token]] = [[]]
        for token in self.tokens:
            if len(parts) <= 2 and token.spans_dots:
                return None
            if token.literal == "." and len(parts) <= 2:
                parts.append([])
            else:
                parts[-1].append(token)
        return [Pattern(tuple(part)) for part in parts]


def _ends_of_matches(steps: Iterable[str | re.Pattern[str]], path: str) -> Collection[int]:
    """Return where matches that start at 0 end."""
    ends: Collection[int] = (0,)
    for step in steps:
        if not ends:
            return ends
        if isinstance(step, str):
            ends = range(min(ends), len(path) + 1) if step == "**" else _ends_of_star(ends, path)
        else:
            ends = [match.end() for end in ends if (match := step.match(path, end))]
    return ends


def _ends_of_star(ends: Collection[int], path: str) -> list[int]:
    """Return where matches of `*` end that start at `ends`."""
    reached: list[int] = []
    for end in sorted(ends):
        if not reached or end > reached[-1]:
            dot = path.find(".", end)
            reached += range(end, (len(path) if dot < 0 else dot) + 1)
    return reached


@cache
def _compiled(regex: str) -> re.Pattern[str]:
    return re.compile(regex, re.DOTALL)


@lru_cache(maxsize=4096)  # each run of a study has the same keys
def compile_pattern(text: str) -> Pattern:
    """Compile the text of a key.

    Raises:
        BadValue: A brace is not closed, a range is empty, a backslash stands at the end, or it is too long.
    """
    if len(text) > LONGEST_PATTERN:
        expected = f"at most {LONGEST_PATTERN}"
        raise BadValue(f"the pattern `{text:.20}…` has {len(text)} characters", expected=expected)
    tokens = []
    position = 0
    while position < len(text):
        token, position = _token(text, position)
        tokens.append(token)
    return Pattern(tuple(tokens))


def _token(text: str, position: int) -> tuple[Token, int]:
    """The token that starts at `position`, and where the next one starts."""
    character = text[position]
    if text.startswith("**", position):
        return Token("**", ".*", spans_dots=True), position + 2
    if character == "*":
        return Token("*", "[^.]*"), position + 1
    if character == "?":
        return Token("?", "[^.]"), position + 1
    if match := _NUMBER_RANGE.match(text, position):
        low, high = match.group(1, 2) if character == "[" else match.group(3, 4)
        return _number_range(match.group(), low, high), match.end()
    if character == "{":
        end = text.find("}", position + 2)
        if end < 0:
            raise BadValue("`{` is not closed", expected="`}` after it (a plain brace is written `\\{`)")
        return _character_set(text[position + 1 : end]), end + 1
    if character == "\\":
        if position + 1 == len(text):
            raise BadValue("a backslash stands at the end; expected a character after it")
        return _literal(text[position + 1], escaped=True), position + 2
    return _literal(character), position + 1


@cache
def _literal(character: str, escaped: bool = False) -> Token:
    return Token(f"\\{character}" if escaped else character, re.escape(character), literal=character)


def _character_set(content: str) -> Token:
    negated = content.startswith("^")
    members = content[1:] if negated else content
    if not members:
        raise BadValue("`{^}` holds no characters; expected some, such as `{^a-z}`")
    parts = []
    position = 0
    while position < len(members):
        first = last = members[position]
        if members[position + 1 : position + 2] == "-" and position + 2 < len(members):
            last = members[position + 2]
            position += 2
        if last < first:
            raise BadValue(f"the range `{first}-{last}` is empty; expected `{last}-{first}`")
        parts.append(f"{re.escape(first)}-{re.escape(last)}")
        position += 1
    regex = f"[{'^' if negated else ''}{''.join(parts)}]"
    return Token(f"{{{content}}}", regex, spans_dots=re.match(regex, ".") is not None)


def _number_range(text: str, low: str, high: str) -> Token:
    """A token for the decimal numbers low..high. The number ends where its digits end."""
    low, high = low.lstrip("0"), high and (high.lstrip("0") or "0")
    if max(len(low), len(high)) > _MOST_DIGITS:
        raise BadValue(f"the range `{text:.20}...` has a number of more than {_MOST_DIGITS} digits")
    first = int(low or "0")
    if high and int(high) < first:
        raise BadValue(f"the range `{text}` is empty; expected the smaller number first")
    if high:
        alternatives = _bounded(first, int(high))
    else:
        digits = len(str(first))
        alternatives = [*_bounded(first, 10**digits - 1), f"[1-9][0-9]{{{digits},}}"]
    number = f"0*(?:{'|'.join(alternatives)})(?![0-9])"
    return Token(text, rf"\[{number}\]" if text.startswith("[") else number)


def _bounded(first: int, last: int) -> list[str]:
    """One regular expression per number of digits."""
    alternatives = []
    while first <= last:
        end = min(last, 10 ** len(str(first)) - 1)
        alternatives.append(_same_length(str(first), str(end)))
        first = end + 1
    return alternatives


def _same_length(low: str, high: str) -> str:
    if low == high:
        return low
    if len(low) == 1:
        return f"[{low}-{high}]"
    if low[0] == high[0]:
        return low[0] + _same_length(low[1:], high[1:])
    count = len(low) - 1
    alternatives = [low[0] + _same_length(low[1:], "9" * count)]
    if int(low[0]) + 1 < int(high[0]):
        alternatives.append(f"[{int(low[0]) + 1}-{int(high[0]) - 1}][0-9]{{{count}}}")
    alternatives.append(high[0] + _same_length("0" * count, high[1:]))
    return f"(?:{'|'.join(alternatives)})"


Item = TypeVar("Item")


class PatternIndex(Generic[Item]):
    """Items, each with a pattern. A path is compared only with patterns whose landmark it has."""

    def __init__(self) -> None:
        """Start empty."""
        self._count = 0
        self._by_landmark: dict[str, dict[str, tuple[Pattern, list[tuple[int, Item]]]]] = {}

    def add(self, pattern: Pattern, item: Item) -> None:
        """Add an item. Several may have the same pattern."""
        by_text = self._by_landmark.setdefault(pattern.landmark, {})
        by_text.setdefault(pattern.text, (pattern, []))[1].append((self._count, item))
        self._count += 1

    def matching(self, path: str) -> list[Item]:
        """Return the items whose patterns match, in the order in which they were added."""
        names = path.split(".")
        landmarks = {"", *names, *(f"{name.partition('[')[0]}[" for name in names if "[" in name)}
        found: list[tuple[int, Item]] = []
        for landmark in landmarks & self._by_landmark.keys():
            for pattern, items in self._by_landmark[landmark].values():
                if pattern.matches(path):
                    found += items
        return [item for _, item in sorted(found, key=itemgetter(0))]
