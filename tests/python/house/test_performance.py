"""Each figure of docs/performance.md names a script of bench that prints it, with its goal."""

import re
from pathlib import Path

PAGE = "docs/performance.md"


def test_its_scripts_have_its_goals_and_benchmarks(root: Path) -> None:
    rows = re.findall(
        r"^\|[^|]*\|([^|]*\d[^|]*)\|([^|]*)\|([^|]*)\|$", (root / PAGE).read_text(), re.MULTILINE
    )
    assert len(rows) > 6
    sources = {str(file.relative_to(root / "bench")): file.read_text() for file in root.glob("bench/*/*.*")}
    text = "".join(sources.values())
    for measured, goal, scripts in rows:
        for name in re.findall(r"`([^`]+)`", scripts):
            assert name in sources or f"BENCHMARK({name})" in text, name
        for figure in re.findall(r"[\d.]+", goal):
            named = [sources[name] for name in re.findall(r"`([^`]+)`", scripts) if name in sources]
            assert any(figure in source for source in (named or [text])), (goal, scripts)
        if goal.strip().startswith("at most"):
            least = min(float(figure) for figure in re.findall(r"[\d.]+", measured.partition("<")[0]))
            assert ("missed" in goal) == (least > float(re.findall(r"[\d.]+", goal)[0]))
