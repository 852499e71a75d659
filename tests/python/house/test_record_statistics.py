"""What docs/how-to/record-statistics.md shows is what is written."""

import csv
import importlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import load_scenarios

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/record-statistics.md"

CodeBlocks = Callable[[str, str], list[str]]
Saved = Callable[..., Path]


def test_its_commands_print_the_first_rows(
    code_blocks: CodeBlocks, saved: Saved, shell: Callable[[str, Path], str], shows: Callable[..., None]
) -> None:
    (commands,) = code_blocks(GUIDE, "sh")
    shows(GUIDE, shell(commands, saved(GUIDE, python="count.py", ini="count.ini")))


@pytest.mark.parametrize("mode", ["prototype", "integrated"])
def test_its_files_have_the_columns_and_rows_of_the_table(saved: Saved, mode: str) -> None:
    module: Any = importlib.import_module(f"gradysim.{mode}.run")
    (scenario,) = load_scenarios(saved(GUIDE, python="count.py", ini="count.ini") / "count.ini")
    heard = module.run(scenario).nodes[0].tracked_variables["heard"]
    times, values = (
        list(csv.DictReader(Path(f"{kind}_demo_Counter_0.csv").read_text(encoding="utf-8").splitlines()))
        for kind in ("simulation_real_time", "tracked_variables")
    )
    assert list(times[0]) == ["", "simulation_time", "real_time"]
    assert list(values[0]) == ["", "simulation_time", "heard"]
    assert len(values) == len(times) + heard
    assert values[-1]["heard"] == str(heard)


def test_one_of_several_runs_leaves_the_file_that_it_names(root: Path, saved: Saved) -> None:
    from gradysim.integrated.run import run

    folder = saved(GUIDE, python="count.py", ini="count.ini")
    (name,) = re.findall(r"`(tracked_variables_General-#3\S+)`", (root / GUIDE).read_text())
    (scenario,) = load_scenarios(folder / "count.ini", runs="3", overrides=["repeat = 4"])
    run(scenario)
    assert [file.name for file in folder.glob("tracked_variables_*_0.csv")] == [name]


def test_its_types_hold(saved: Saved, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(saved(GUIDE, python="count.py", ini="count.ini") / "count.py") == ""
