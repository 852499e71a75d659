"""A row of the table in docs/verification/field.md: one published measurement beside the engine."""

import json
from dataclasses import asdict, dataclass, fields

AGREES, FITTED, DIFFERS = "agrees", "fitted", "**does not agree**"


@dataclass(frozen=True)
class FieldRow:
    """What was measured, and what the engine gives."""

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

    def to_json(self) -> str:
        """Return the row as JSON; the inverse of `from_json`."""
        return json.dumps(asdict(self))

    @classmethod
    def from_json(cls, text: str) -> "FieldRow":
        """Return the row of a string made by `to_json`."""
        return cls(**json.loads(text))


def table(rows: list[FieldRow]) -> str:
    """Return the table as Markdown."""
    names = [field.name.replace("row", "") for field in fields(FieldRow)]
    return "\n".join([f"| {' | '.join(names)} |", "|---" * len(names) + "|", *map(str, rows)]) + "\n"
