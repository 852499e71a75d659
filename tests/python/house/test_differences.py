"""docs/reference/differences.md agrees with the profiles and the table of keys."""

import re
from pathlib import Path

import pytest

from gradysim.scenario.parse.ini import PROFILES

PAGE = "docs/reference/differences.md"


def rows(text: str) -> list[dict[str, str]]:
    """Return the rows of all tables, with the heads of the columns as keys."""
    found: list[dict[str, str]] = []
    for table in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE):
        head, _, *lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()]
        found += [dict(zip(head, line, strict=True)) for line in lines]
    return found


@pytest.fixture
def table(root: Path) -> list[dict[str, str]]:
    return rows((root / PAGE).read_text(encoding="utf-8"))


def keys_of(row: dict[str, str]) -> list[str]:
    return re.findall(r"`([^`]+)`", row.get("key", ""))


def test_its_keys_and_defaults_are_those_of_the_reference(root: Path, table: list[dict[str, str]]) -> None:
    reference = rows((root / "docs/reference/keys.md").read_text(encoding="utf-8"))
    defaults = {row["key"].strip("`"): row["default"] for row in reference if "default" in row}
    for row in table:
        named = [
            [default for key, default in defaults.items() if key.endswith(f".{end}")] for end in keys_of(row)
        ]
        assert all(named), row["rule"]
        for value in re.findall(r"`([-\d\"][^`]*)`", row["here"]):
            assert any(value in default for found in named for default in found), (row["rule"], value)


@pytest.mark.parametrize(("profile", "column"), [("as_inet.ini", "INET"), ("as_ns3.ini", "ns-3")])
def test_each_line_of_a_profile_has_a_row_with_its_number(
    table: list[dict[str, str]], profile: str, column: str
) -> None:
    lines = re.findall(r"^(\*\S+) = (.*)$", (PROFILES / profile).read_text(), re.MULTILINE)
    assert lines
    for key, value in lines:
        (row,) = (row for row in table if any(key.endswith(f".{end}") for end in keys_of(row)))
        if re.match(r"-?\d", value):
            numbers = (value, re.sub(r"(?<=\d)(?=[a-zA-Z])", " ", value), value.replace("4us", "4 µs"))
            assert any(number in row[column] for number in numbers), (key, row[column])
