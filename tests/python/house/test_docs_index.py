"""docs/README.md leads to every document."""

from collections.abc import Callable
from pathlib import Path

FOLDERS_WITH_AN_INDEX = {"decisions", "verification"}


def test_every_page_is_in_the_index(root: Path, project_files: Callable[..., list[Path]]) -> None:
    index = (root / "docs/README.md").read_text()
    pages = {file.relative_to("docs") for file in project_files(".md") if file.parts[0] == "docs"}
    wanted = {
        page / "README.md" if (page := Path(file.parts[0])).name in FOLDERS_WITH_AN_INDEX else file
        for file in pages - {Path("README.md")}
    }
    assert sorted(str(page) for page in wanted if f"({page})" not in index) == []
