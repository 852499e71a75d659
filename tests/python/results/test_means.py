import json
from pathlib import Path
from typing import Any

import pytest

from gradysim.results.means import Mean, means, of_different_files, of_different_settings, read_results


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
        "fates": {},
        "nodes": nodes,
        **changes,
    }


def quantities(results: list[dict[str, Any]]) -> dict[str, float]:
    return {mean.quantity: mean.mean for mean in means(results)}


def test_a_tracked_variable_counts_with_the_mean_of_its_group() -> None:
    (mean,) = means([result(0, (1, 3)), result(1, (3, 5))])
    assert mean == Mean(
        "Study", "integrated", {"jitter": "10ms"}, "uavs[*] heard", 2, 3.0, pytest.approx(12.706, abs=1e-3)
    )


def test_groups_and_single_nodes_are_apart() -> None:
    nodes = [
        {"name": "groundStation", "tracked_variables": {"heard": 7, "said": 2.5}},
        {"name": "uavs[0]", "tracked_variables": {"heard": 1}},
    ]
    assert quantities([result(nodes=nodes)]) == {
        "groundStation heard": 7,
        "groundStation said": 2.5,
        "uavs[*] heard": 1,
    }


@pytest.mark.parametrize("value", ["7", None, [1, 2], float("nan"), float("inf"), 10**400])
def test_what_is_no_finite_number_is_left_out(value: object) -> None:
    assert quantities([result(0, (value, 3))]) == {"uavs[*] heard": 3}
    assert quantities([result(0, (value,))]) == {}


@pytest.mark.parametrize("what", ["frames", "copies"])
def test_the_share_of_copies_that_arrived(what: str) -> None:
    fates = {
        what: {
            "broadcast": {"delivered": 6, "interference": 2, "in_air": 12},
            "unicast": {"delivered": 0},
            "unicast overheard": {"delivered": 5},
        },
        "messages": {"broadcast": {"sent": 3}},
    }
    assert quantities([result(0, (), fates=fates)]) == {"broadcast delivered": 0.75}


def test_other_values_modes_and_configurations_are_apart() -> None:
    changes: list[dict[str, Any]] = [
        {},
        {"iterations": {"jitter": "20ms"}},
        {"iterations": {}},
        {"mode": "prototype"},
        {"config": "Other"},
    ]
    found = means([result(run, (run,), **change) for run, change in enumerate(changes)])
    assert [(mean.mean, mean.runs, mean.half_width) for mean in found] == [
        (run, 1, None) for run in range(len(changes))
    ]


def test_the_order_of_variables_does_not_matter() -> None:
    (mean,) = means([result(0, iterations={"x": 1, "y": 2}), result(1, iterations={"y": 2, "x": 1})])
    assert mean.runs == 2


def test_runs_of_equal_values_and_different_settings_are_named() -> None:
    results = [result(3), result(4, settings_hash="a"), result(5, settings_hash="b")]
    assert of_different_settings(results) == ("Study-#3", "Study-#4")
    assert of_different_settings(results[1:]) == ("Study-#4", "Study-#5")


def test_settings_may_differ_with_the_values() -> None:
    results = [result(0, settings_hash="a"), result(1, settings_hash="b", iterations={"jitter": "20ms"})]
    assert of_different_settings(results) is None


def test_runs_made_with_different_files_of_one_name_are_told() -> None:
    results = [
        result(0, file_hashes={"a.py": "1", "b.py": "1"}),
        result(1, file_hashes={"a.py": "1"}, iterations={"jitter": "20ms"}),
        result(2, file_hashes={"a.py": "1", "b.py": "2"}, mode="prototype"),
    ]
    assert of_different_files(results) == ("Study-#0.integrated", "Study-#2.prototype", "b.py")
    assert of_different_files(results[:2]) is None


def test_other_configurations_and_results_of_before_say_nothing_of_files() -> None:
    results = [
        result(0, file_hashes={"a.py": "1"}),
        result(0, file_hashes={"a.py": "2"}, config="Other"),
        result(1),
    ]
    assert of_different_files(results) is None


def test_results_are_read_in_the_order_of_their_runs(tmp_path: Path) -> None:
    for run in (10, 9):
        (tmp_path / f"Study-#{run}.integrated.json").write_text(json.dumps(result(run)))
    assert [read["run"] for read in read_results(tmp_path)] == [9, 10]


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
