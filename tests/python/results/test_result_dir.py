import json
from pathlib import Path
from typing import Any

import pytest

from gradysim.results.result_dir import has_files_for_omnetpp_alone, read_results
from gradysim.scenario.errors import ConfigError


def result(run: int = 0, heard: tuple[object, ...] = (1, 3), **changes: Any) -> dict[str, Any]:
    nodes = [
        {"name": f"uavs[{index}]", "tracked_variables": {"heard": value}} for index, value in enumerate(heard)
    ]
    return {
        "config": "Study",
        "mode": "integrated",
        "run": run,
        "interrupted": False,
        "iterations": {"jitter": "10ms"},
        "outcomes": {},
        "nodes": nodes,
        **changes,
    }


def test_results_are_read_in_the_order_of_their_runs(tmp_path: Path) -> None:
    for run in (10, 9):
        (tmp_path / f"Study-#{run}.integrated.json").write_text(json.dumps(result(run)))
    assert [read.run for read in read_results(tmp_path)] == [9, 10]


def test_other_files_and_interrupted_runs_are_left_out(tmp_path: Path) -> None:
    (tmp_path / "interrupted.json").write_text(json.dumps(result(interrupted=True)))
    (tmp_path / "half.json").write_text('{"config": ')
    (tmp_path / "list.json").write_text("[1]")
    (tmp_path / "deep.json").write_text("[" * 99_999)
    (tmp_path / "other.json").write_text('{"config": "Study"}')
    (tmp_path / "notes.txt").write_text(json.dumps(result()))
    (tmp_path / "binary.json").write_bytes(b"\xff\xfe")
    (tmp_path / "folder.json").mkdir()
    assert read_results(tmp_path) == []


@pytest.mark.parametrize("text", ['{"config": ', "[1]", "[" * 99_999, '{"checksum": "0123456789abcdef"}'])
def test_a_damaged_result_is_an_error_that_names_it(tmp_path: Path, text: str) -> None:
    (tmp_path / "Study-#0.integrated.json").write_text(json.dumps(result()))
    file = tmp_path / "Study-#1.integrated.json"
    file.write_text(text)
    with pytest.raises(ConfigError) as raised:
        read_results(tmp_path)
    assert raised.value.file == file


@pytest.mark.parametrize("interrupted", [True, False])
def test_a_folder_with_any_result_has_not_only_files_for_omnetpp(tmp_path: Path, interrupted: bool) -> None:
    assert not has_files_for_omnetpp_alone(tmp_path)
    (tmp_path / "Study-#0.integrated.sca").touch()
    (tmp_path / "half.json").write_text("{")
    assert has_files_for_omnetpp_alone(tmp_path)
    (tmp_path / "Study-#0.integrated.json").write_text(json.dumps(result(interrupted=interrupted)))
    assert not has_files_for_omnetpp_alone(tmp_path)


def test_equal_conditions_are_one_object(tmp_path: Path) -> None:
    several: list[dict[str, Any]] = [{}, {"seed": 5}, {"iterations": {"jitter": "20ms"}}]
    for run, changes in enumerate(several):
        (tmp_path / f"Study-#{run}.integrated.json").write_text(json.dumps(result(run, **changes)))
    first, second, other = (summary.conditions for summary in read_results(tmp_path))
    assert first is second
    assert first is not other
