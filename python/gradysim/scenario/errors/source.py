"""Where a value of a scenario was written: what an error message points at."""

from dataclasses import dataclass
from pathlib import Path

_MOST_LETTERS = 200
"""Of a value in a message. The corners of an outline would fill a screen before it says what is wrong."""


def shortened(value: str) -> str:
    """A value as messages have it: of a long one only the beginning."""
    return value if len(value) <= _MOST_LETTERS else f"{value[: _MOST_LETTERS // 2]}…"


@dataclass(frozen=True)
class Source:
    """The place of one line of a configuration.

    Attributes:
        file: The .ini file, as the user named it. For an override: the file that it overrides.
        line: The line, counted from 1; 0 for an override and for the whole file.
        key: The key as it was written, or "" where no key is concerned.
        value: The value as it was written.
        option: What an override was given to, such as `--set`; "" for all that a file says.
    """

    file: Path
    line: int
    key: str = ""
    value: str = ""
    option: str = ""

    @property
    def is_override(self) -> bool:
        """Whether the value stands in no file."""
        return bool(self.option)

    def __str__(self) -> str:
        if self.is_override:
            return f"{self.option} {self.key}={shortened(self.value)}"
        return f"{self.file}:{self.line}" if self.line else str(self.file)
