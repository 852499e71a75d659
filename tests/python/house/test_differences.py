"""docs/reference/differences.md agrees with the profiles, the table of keys and the verification."""

import re
from pathlib import Path

import pytest

from gradysim.scenario.ini import PROFILES
from python.house.verified import FIGURE, repeats

PAGE = "docs/reference/differences.md"

SOURCES = {
    "EIFS after a broken frame": "with INET's EIFS, 100 seeds",
    "window after a message that is given up": {
        "24.5 %": "with INET's contention window: messages received",
        "50.5 %": "with INET's contention window: messages received",
        "3.2 times": "by default 3.2 times as many frames",
    },
    "own frames set the NAV": "costs 8 % here",
    "NAV of an RTS that no frame follows": "station 3 of the chain of five",
    "a frame that arrives at the instant in which a slot ends": "5 to 15 stations have",
    "preamble detection": "6 and 54 Mbps, 1 to 30 stations, against INET and ns-3",
    "channel after a lost PHY header": "Without that rule, station 1",
    "bit errors": "without RTS/CTS, ns-3's table of error rates",
    "rest after an exchange": "no interframe space",
    "wait for an ACK": "longer wait for an ACK",
    "the channel is busy if it is so": "assessment of the whole 128",
}
"""The statement of the verification for the figures of a row, or for each of them."""


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


def test_its_figures_are_those_of_the_verification(root: Path, table: list[dict[str, str]]) -> None:
    found = {row["rule"]: FIGURE.findall(row.get("effect of the default", "")) for row in table}
    assert {rule for rule, figures in found.items() if figures} == set(SOURCES)
    for rule, source in SOURCES.items():
        for figure in found[rule]:
            phrase = source if isinstance(source, str) else source[figure]
            assert repeats(root, figure, phrase), (rule, figure)
