"""The errors of a configuration: for the person who wrote the file, with the place and what was expected."""

import re
from pathlib import Path
from typing import Self

from gradysim.scenario.errors.source import Source, shortened

_LONG_WORD = re.compile(r"\S{1000,}")
"""A value in a message, such as a number of a thousand digits: neither a name nor a path is as long."""


class ConfigError(ValueError):
    """A mistake in a configuration. Its text is "FILE:LINE: what is wrong; what was expected".

    Attributes:
        message: The text without the place.
        source: The place, or None for a mistake that has none (a run number that does not exist).
        file: The file of the place, or None.
        line: The line of the place; 0 for an override, for a whole file and for no place.
        key: The key concerned, or "".
    """

    def __init__(self, message: str, source: Source | None = None) -> None:
        message = _LONG_WORD.sub(lambda word: shortened(word[0]), message)
        super().__init__(message, source)
        self.message = message
        self.source = source
        self.file: Path | None = source.file if source else None
        self.line = source.line if source else 0
        self.key = source.key if source else ""

    @classmethod
    def at(cls, source: Source, text: str) -> Self:
        """An error found elsewhere (the engine's check of a range, say) in the value at `source`."""
        is_told = source.is_override or not source.key
        return cls(text if is_told else f"{source.key} = {shortened(source.value)}: {text}", source)

    def __str__(self) -> str:
        return f"{self.source}: {self.message}" if self.source else self.message


class BadValue(ValueError):  # noqa: N818 - no error of its own: see below
    """A text is not a value of the kind that was asked for. Who knows the place turns it into a ConfigError.

    Attributes:
        problem: What is wrong.
        suggestion: "" or "; did you mean ...?", to be put at the end of the whole message.
        expected: What was expected, if that is more to the point than what such values have to be in general.
    """

    def __init__(self, problem: str, suggestion: str = "", *, expected: str = "") -> None:
        super().__init__(problem + suggestion)
        self.problem = problem
        self.suggestion = suggestion
        self.expected = expected
