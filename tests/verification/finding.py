"""Results of comparisons: the rows of the tables in docs/verification."""

from dataclasses import asdict, dataclass, fields

AGREES, FITTED, DIFFERS, SHOWN = "agrees", "fitted", "**does not agree**", "shown only"


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


@dataclass(frozen=True)
class FieldRow:
    """A row of the table in docs/verification/field.md: what was measured, and what the engine gives."""

    row: str
    quantity: str
    measured: str
    engine: str
    fitted: str
    """Parameter that was fitted to the measurement, and its value; "" for none."""
    verdict: str
    tolerance: str
    source: str
    """Number of its source on the page, and what the measurement does not say."""

    def __str__(self) -> str:
        return f"| {' | '.join(asdict(self).values())} |"


def table(findings: list[Finding]) -> str:
    """Return the table as Markdown, in the given order."""
    head = "| comparison | measured | tolerance | verdict | why that tolerance |\n|---|---|---|---|---|\n"
    return head + "".join(f"{finding.row}\n" for finding in findings)


def field_table(rows: list[FieldRow]) -> str:
    """Return the table of published measurements as Markdown, by letter."""
    rows = sorted(rows, key=lambda row: row.row)
    names = [field.name.replace("row", "") for field in fields(FieldRow)]
    return "\n".join([f"| {' | '.join(names)} |", "|---" * len(names) + "|", *map(str, rows)]) + "\n"
