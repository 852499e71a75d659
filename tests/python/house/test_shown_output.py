"""`make pages` corrects what a page shows of a command's output, and leaves the rest."""

from pathlib import Path

import pytest

from python.shown_output import check_block

PAGE = """# Count

```sh
count
```

```text
node      heard
station       7
```

It heard 7. Another command:

```text
run 0, 1.5 s
…
run 9, 1.5 s
```
"""
OUTPUT = "node      heard   \nstation       7\n"
LINES = "".join(f"run {number}, 0.3 s\n" for number in range(10))


@pytest.fixture
def page(tmp_path: Path) -> Path:
    (tmp_path / "count.md").write_text(PAGE, encoding="utf-8")
    return tmp_path / "count.md"


def test_a_block_that_is_right_stays(page: Path) -> None:
    check_block(page, OUTPUT, 0, rewrite=True)
    check_block(page, LINES, 1, changing=True, rewrite=True)
    assert page.read_text() == PAGE


@pytest.mark.parametrize(
    "damaged", [PAGE.replace("station       7", "station       8"), PAGE.replace("node      heard\n", "")]
)
def test_a_damaged_block_is_an_error_and_is_restored(page: Path, damaged: str) -> None:
    page.write_text(damaged)
    with pytest.raises(AssertionError, match="make pages"):
        check_block(page, OUTPUT, 0, rewrite=False)
    check_block(page, OUTPUT, 0, rewrite=True)
    assert page.read_text() == PAGE


def test_a_block_that_shows_a_part_stays_a_part(page: Path) -> None:
    page.write_text(PAGE.replace("station       7", "station       8"))
    check_block(page, f"General run 0\n\n{OUTPUT}\ntotal         7\n", 0, part=True, rewrite=True)
    assert page.read_text() == PAGE


def test_lines_around_a_gap_are_corrected_and_times_stay(page: Path) -> None:
    page.write_text(PAGE.replace("run 9", "runs 9"))
    check_block(page, LINES, 1, changing=True, rewrite=True)
    assert page.read_text() == PAGE.replace("run 9, 1.5 s", "run 9, 0.3 s")


def test_lines_that_are_not_shown_are_an_error_without_a_gap(page: Path) -> None:
    with pytest.raises(AssertionError, match="make pages"):
        check_block(page, f"{OUTPUT}vehicle       6\n", 0, rewrite=False)
