"""Where a value of a scenario was written: what an error message points at."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Source:
    """The place of one line of a configuration.

    Attributes:
        file: The .ini file, as the user named it. For the command line: the file that it overrides.
        line: The line, counted from 1. 0 is the command line if there is a key, and the whole file if not.
        key: The key as it was written, or "" where no key is concerned.
        value: The value as it was written.
    """

    file: Path
    line: int
    key: str = ""
    value: str = ""

    @property
    def is_command_line(self) -> bool:
        """Whether the value came from `--set KEY=VALUE`."""
        return self.line == 0 and bool(self.key)

    def __str__(self) -> str:
        if self.line > 0:
            return f"{self.file}:{self.line}"
        return f"--set {self.key}={self.value}" if self.key else str(self.file)
