"""The tables of docs/reference/results.md are made from the declarations of the fields."""

from pathlib import Path

from gradysim.results.reference import with_tables

PAGE = "docs/reference/results.md"


def test_the_tables_are_up_to_date(root: Path) -> None:
    page = (root / PAGE).read_text(encoding="utf-8")
    assert page.count("<!-- end -->") == 2
    assert with_tables(page) == page, f"run `python -m gradysim.results.reference {PAGE}`"
