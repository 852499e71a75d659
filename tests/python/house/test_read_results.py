"""What docs/how-to/read-results.md shows runs with the README's first protocol."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.results import read_means
from gradysim.scenario import load_scenarios

GUIDE = "docs/how-to/read-results.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def shown(code_blocks: CodeBlocks) -> dict[str, Any]:
    """The functions that it defines."""
    names: dict[str, Any] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    return names


@pytest.fixture
def folder(code_blocks: CodeBlocks, tmp_path: Path) -> Path:
    """A folder with the first protocol."""
    for language, name in [("python", "hello.py"), ("ini", "hello.ini")]:
        (tmp_path / name).write_text(code_blocks("README.md", language)[0], encoding="utf-8")
    return tmp_path


def test_rows_of_both_modes_come_out_of_the_file(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], folder: Path, shown: dict[str, Any]
) -> None:
    (commands,) = code_blocks(GUIDE, "sh")
    shell(commands, folder)
    file = str(folder / "runs.jsonl")
    rows = list(shown["rows"](file))
    assert len(rows) == 2 * 5 * 4
    assert rows[0].keys() == {"mode", "run", "node", "heard"}
    assert shown["heard"](file, "prototype") == (177, 0)


def test_an_interrupted_run_is_left_out(folder: Path, shown: dict[str, Any]) -> None:
    file = folder / "runs.jsonl"
    file.write_text(json.dumps({"interrupted": True, "nodes": [{"name": "nodes[0]"}]}) + "\n")
    assert list(shown["rows"](str(file))) == []


def test_its_study_compares_both_modes(folder: Path, shown: dict[str, Any]) -> None:
    totals = list(shown["study"](str(folder / "hello.ini"), ["0s", "100ms"]))
    assert len(totals) == 2 * 3 * 2
    assert totals[:2] == [("0s", "prototype", 0, 720), ("0s", "integrated", 0, 0)]
    assert totals[-2:] == [("100ms", "prototype", 2, 708), ("100ms", "integrated", 2, 708)]


@pytest.fixture
def done_study(code_blocks: CodeBlocks, shell: Callable[[str, Path], str], folder: Path) -> Path:
    """The folder, with the results of the README's study."""
    with (folder / "hello.ini").open("a") as file:
        file.write(code_blocks("README.md", "ini")[1])
    shell("gradysim run hello.ini -c Study --result-dir results --quiet", folder)
    return folder


def test_the_means_of_the_study_are_those_that_are_shown(
    root: Path, code_blocks: CodeBlocks, shell: Callable[[str, Path], str], done_study: Path
) -> None:
    _, table = code_blocks(GUIDE, "text")
    printed = shell("gradysim means results", done_study).splitlines()
    assert [line.rstrip() for line in printed] == table.splitlines()
    some = re.search(r"`(gradysim means results '.*?)`", (root / GUIDE).read_text())
    assert some is not None
    rows = [line.split() for line in shell(some[1], done_study).splitlines()[3:]]
    assert rows == [line.split() for line in table.splitlines() if " heard " in line or " delay " in line]


def test_its_means_in_a_script_are_those_of_the_command(done_study: Path, shown: dict[str, Any]) -> None:
    results = str(done_study / "results")
    nodes = {mean.iterations["jitter"]: mean for mean in read_means(results, "nodes[*] heard")}
    greetings = 59  # of each node; each of the four hears as many of them
    assert shown["heard_by"](results) == {
        jitter: pytest.approx((mean.mean / greetings, mean.half_width / greetings))
        for jitter, mean in nodes.items()
    }
    delays = [mean.mean for mean in read_means(results) if "delay" in mean.quantity]
    assert list(shown["mean_delays_s"](results).values()) == delays


def test_its_other_order_of_runs(root: Path, folder: Path) -> None:
    line = "iteration-nesting-order = repetition, *"
    assert f"| `{line}` |" in (root / GUIDE).read_text()
    values = ["*.nodes[*].protocol.jitter = ${1ms, 2ms}", "repeat = 2"]
    scenarios = load_scenarios(folder / "hello.ini", overrides=[*values, line])
    runs = [(scenario.repetition, scenario.iterations["0"]) for scenario in scenarios]
    assert runs == [(0, "1ms"), (0, "2ms"), (1, "1ms"), (1, "2ms")]


@pytest.mark.parametrize(
    ("line", "runs"),
    [
        ("*.nodes[*].protocol.jitter = ${10ms, 50ms}", 2),
        ("*.nodes[*].mobility.lineStepX = ${10..60 step 10}m", 6),
        ("seed-set = ${repetition}", 1),
    ],
)
def test_lines_of_studies_are_understood(root: Path, folder: Path, line: str, runs: int) -> None:
    assert f"| `{line}` |" in (root / GUIDE).read_text()
    scenarios = load_scenarios(folder / "hello.ini", overrides=[line])
    assert len(scenarios) == runs


@pytest.fixture
def hidden(code_blocks: CodeBlocks, folder: Path) -> Path:
    """The folder, with the configuration whose nodes are hidden from each other."""
    with (folder / "hello.ini").open("a") as file:
        file.write(code_blocks(GUIDE, "ini")[0])
    return folder


def test_what_it_shows_of_single_nodes_is_the_end_of_the_summary(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], hidden: Path
) -> None:
    shown = [line for line in code_blocks(GUIDE, "text")[0].splitlines() if line]
    printed = shell("gradysim run hello.ini -c Hidden --fates-at nodes", hidden).splitlines()
    assert [line.rstrip() for line in printed if line.strip()][-len(shown) :] == shown


def test_its_rows_of_interference_are_those_of_the_summary(
    shell: Callable[[str, Path], str], hidden: Path, shown: dict[str, Any]
) -> None:
    shell("gradysim run hello.ini -c Hidden --fates-at nodes[1] --json > runs.jsonl", hidden)
    rows = list(shown["interference"](str(hidden / "runs.jsonl")))
    assert [(row["run"], row["at"], row["by"], row["lost"]) for row in rows] == [
        (0, "nodes[1]", "nodes[0]", 3),
        (0, "nodes[1]", "nodes[2]", 2),
        (0, "nodes[1]", "nodes[3]", 5),
    ]
