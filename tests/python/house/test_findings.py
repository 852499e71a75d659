"""Each measured figure in prose cites a finding of docs/verification/findings.csv, and has its value.

A figure, or several such as `4 % or 5 %`, is followed by `<!-- finding: id -->`. Tables that `make verify`
writes have their figures from the same runs.
"""

import json
import re
from pathlib import Path

import pytest

from findings import COLUMNS, FILE, record, recorded
from findings.__main__ import main

GENERAL = r"\d+(?:\.\d+)? %|\d+\.\d+ times|0 of \d+|\d+e-\d+|0\.\d{3,}"
CELL = r"(?<=\| )[\d.]+(?: to [\d.]+)?(?: n?s)?(?= \||<!)|(?<=, )[\d.]+ ns|(?<= / )[\d.]+ s"
PAGES = {
    "README.md": f"{GENERAL}|(?<=\\| )[\\d.]+ s(?= \\||<)",
    "docs/performance.md": f"{GENERAL}|{CELL}",
    "docs/explanation/what-is-true.md": GENERAL,
    "docs/reference/differences.md": GENERAL,
    "docs/verification/README.md": GENERAL,
    "docs/verification/field.md": rf"{GENERAL}|-?\d+(?:\.\d+)? dB\b",
}
"""{page: what a measured figure looks like there}."""

NOT_PROSE = re.compile(
    r"<!-- table: written.*?<!-- end of table -->|```.*?```|`[^`\n]*`|\]\([^)]*\)|doi \S+", re.DOTALL
)
SIZES = (100, 1_000, 10_000)
CITED = re.compile(r"<!-- finding: (.+?) -->")
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e-?\d+)?")


def figures(text: str, pattern: str) -> list[tuple[str, str]]:
    """Return each figure with the id that it cites, or ""."""
    prose = NOT_PROSE.sub(lambda found: re.sub(r"[^\n]", "#", found[0]), text)
    several = re.compile(rf"(?:{pattern})(?:\s+(?:to|and|or)\s+(?:{pattern}))*")
    found = []
    for figure in several.finditer(prose):
        cited = CITED.match(text, figure.end())
        found.append((" ".join(figure[0].split()), cited[1] if cited else ""))
    return found


def has(value: str, figure: str) -> bool:
    """Return whether each number of the figure is one of the value, rounded as written."""

    def is_in(number: str) -> bool:
        digits = len(number.partition(".")[2])
        return any(number in (each, f"{float(each):.{digits}f}") for each in NUMBER.findall(value))

    return all(is_in(number) for number in NUMBER.findall(figure))


@pytest.mark.parametrize("page", PAGES)
def test_each_measured_figure_cites_a_finding_and_has_its_value(root: Path, page: str) -> None:
    text = (root / page).read_text(encoding="utf-8")
    rows, found = recorded(), figures(text, PAGES[page])
    assert len(found) > 0
    wrong = [
        (figure, cited or "nothing cited")
        for figure, cited in found
        if cited not in rows or not has(rows[cited]["value"], figure)
    ]
    assert wrong == []
    assert len(CITED.findall(text)) == len(found)  # a citation without a figure would not be compared


def test_a_figure_that_cites_nothing_or_another_value_is_noticed() -> None:
    text = "| a | 4 % or\n5 %<!-- finding: a --> | 6 %, 0.25 % <!-- finding: b -->\n```\n7 %\n```\n"
    assert figures(text, GENERAL) == [("4 % or 5 %", "a"), ("6 %", ""), ("0.25 %", "")]
    assert has("-0.0046% (4 dB)", "0.0046 %")
    assert has("differs by 0.86%, 9.0%", "0.9 %")
    assert has("9.0%", "9 %")
    assert has("4e-10", "4e-10")
    assert not has("0.86%", "0.8 %")
    assert not has("4%; 9%", "4 % to 10 %")


def test_a_record_keeps_the_other_rows(tmp_path: Path) -> None:
    file = tmp_path / "findings.csv"
    file.write_text(",".join(COLUMNS) + "\nz,1,,abc,here,2026-01-01,by hand\n", encoding="utf-8")
    record("a", "2, 3", "s", "bench", file)
    record("a", "4, 5", "s", "bench", file)
    rows = recorded(file)
    assert list(rows) == ["a", "z"]
    assert rows["a"]["value"] == "4, 5"
    assert all(rows["a"].values())
    assert rows["z"]["machine"] == "here"


def test_the_figures_of_the_benchmarks_of_the_engine_are_recorded(tmp_path: Path) -> None:
    ns = {f"{name}/{nodes}": nodes / 100 for name in ("standing", "flying", "at_1_mbps") for nodes in SIZES}
    ns["standing_in_100_networks/100/min_time:2.000"] = 50
    results = [{"name": name, "ns_per_frame": each} for name, each in ns.items()]
    results.append({"name": "dependent_lines/8000000", "cpu_time": 74.6, "time_unit": "ns"})
    (tmp_path / "figures.json").write_text(json.dumps({"benchmarks": results}), encoding="utf-8")
    file = tmp_path / "findings.csv"
    file.write_text(",".join(COLUMNS) + "\n", encoding="utf-8")
    main(tmp_path / "figures.json", file)
    rows = recorded(file)
    assert rows.keys() == {each for each in recorded() if each.startswith("bench.")}
    assert rows["bench.flying_ratio"]["value"] == "100.00"
    assert rows["bench.networks_ratio"]["value"] == "0.50"
    assert (rows["bench.dependent_line"]["value"], rows["bench.dependent_line"]["unit"]) == ("75", "ns")


def test_each_finding_says_when_and_how_it_was_made() -> None:
    rows = recorded()
    assert list(rows) == sorted(rows)
    assert FILE.read_text(encoding="utf-8").count("\n") == len(rows) + 1
    lacking = [each for each, row in rows.items() if not all(row[name] for name in COLUMNS if name != "unit")]
    assert lacking == []
