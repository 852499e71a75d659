"""Result of one comparison, with its tolerance and the reason for the tolerance."""

import json
from dataclasses import asdict, dataclass


@dataclass(frozen=True)
class Finding:
    """A row of the table in docs/verification/README.md."""

    comparison: str
    """Compared quantities."""
    number: str
    """Measured number, with its unit."""
    tolerance: str
    """Tolerance of the number."""
    reason: str
    """Reason for the tolerance."""
    agrees: bool
    """Whether the number is within the tolerance."""

    def __str__(self) -> str:
        verdict = "agrees" if self.agrees else "DIFFERS"
        return f"{self.comparison}: {self.number}; tolerance {self.tolerance} ({self.reason}): {verdict}"

    @property
    def row(self) -> str:
        """Return the row as Markdown."""
        verdict = "agrees" if self.agrees else "**differs**"
        return f"| {self.comparison} | {self.number} | {self.tolerance} | {verdict} | {self.reason} |"

    def to_json(self) -> str:
        """Return the finding as JSON; the inverse of `from_json`."""
        return json.dumps(asdict(self))

    @classmethod
    def from_json(cls, text: str) -> "Finding":
        """Return the finding of a string made by `to_json`."""
        return cls(**json.loads(text))


def table(findings: list[Finding]) -> str:
    """Return the table as Markdown, in the given order."""
    head = "| comparison | measured | tolerance | verdict | why that tolerance |\n|---|---|---|---|---|\n"
    return head + "".join(f"{finding.row}\n" for finding in findings)
