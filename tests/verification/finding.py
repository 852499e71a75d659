"""What one comparison found, with its tolerance and the reason for the tolerance."""

import json
from dataclasses import asdict, dataclass


@dataclass(frozen=True)
class Finding:
    """A row of the table in docs/verification/README.md."""

    comparison: str
    """What is compared with what."""
    number: str
    """The number that was measured, with its unit."""
    tolerance: str
    """What it has to keep within."""
    reason: str
    """Why that tolerance and no other."""
    agrees: bool
    """Whether it does."""

    def __str__(self) -> str:
        verdict = "agrees" if self.agrees else "DIFFERS"
        return f"{self.comparison}: {self.number}; tolerance {self.tolerance} ({self.reason}): {verdict}"

    @property
    def row(self) -> str:
        """The row as Markdown."""
        verdict = "agrees" if self.agrees else "**differs**"
        return f"| {self.comparison} | {self.number} | {self.tolerance} | {verdict} | {self.reason} |"

    def to_json(self) -> str:
        """As text; the inverse is `from_json`."""
        return json.dumps(asdict(self))

    @classmethod
    def from_json(cls, text: str) -> "Finding":
        """The finding of a text made by `to_json`."""
        return cls(**json.loads(text))


def table(findings: list[Finding]) -> str:
    """The table as Markdown, in the order given."""
    head = "| comparison | measured | tolerance | verdict | why that tolerance |\n|---|---|---|---|---|\n"
    return head + "".join(f"{finding.row}\n" for finding in findings)
