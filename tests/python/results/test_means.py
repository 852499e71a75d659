import json
import sys
from pathlib import Path
from typing import Any

import pytest

from gradysim.results.means import (
    Mean,
    means,
    of_different_files,
    of_different_settings,
    read_means,
    repeated,
)
from gradysim.results.result_dir import read_results
from gradysim.results.run_summary import RunSummary


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


def figures(run: int = 0, heard: tuple[object, ...] = (1, 3), **changes: Any) -> RunSummary:
    return RunSummary.of(result(run, heard, **changes))


def quantities(results: list[RunSummary]) -> dict[str, float | None]:
    return {mean.quantity: mean.mean for mean in means(results)}


def test_a_tracked_variable_counts_with_the_mean_of_its_group() -> None:
    (mean,) = means([figures(0, (1, 3)), figures(1, (3, 5))])
    ends = pytest.approx(3 - 12.706, abs=1e-3), pytest.approx(3 + 12.706, abs=1e-3)
    assert mean == Mean("Study", "integrated", {"jitter": "10ms"}, "uavs[*] heard", 2, 3.0, *ends)


@pytest.mark.parametrize(("elsewhere", "low"), [(1, 0.1581), (2, 1)])
def test_an_event_of_all_runs_is_not_certain_unless_it_is_a_count(elsewhere: float, low: float) -> None:
    """The quantity is one of an event if it is 0 or 1 for all values of variables."""
    others = [figures(run, (elsewhere,), iterations={"jitter": "20ms"}) for run in (2, 3)]
    mean = means([figures(0, (1,)), figures(1, (1,)), *others])[0]
    assert (mean.mean, mean.low, mean.high) == (1, pytest.approx(low, abs=1e-4), 1)


def test_a_share_of_all_frames_is_not_an_event() -> None:
    outcomes = {"frames": {"broadcast": {"delivered": 100}}}
    (mean,) = means([figures(run, (), outcomes=outcomes) for run in range(2)])
    assert (mean.mean, mean.low, mean.high) == (1, 1, 1)


def test_a_delay_counts_with_the_mean_of_each_run() -> None:
    delays = [{"unicast": {"mean_s": mean_s}} for mean_s in (0.1, 0.3)]
    results = [figures(run, (), message_delays=each) for run, each in enumerate(delays)]
    assert quantities(results) == {"unicast messages delay in s": pytest.approx(0.2)}


def test_a_run_without_messages_has_no_delay() -> None:
    (mean,) = means([figures(0, (), message_delays={"unicast": {"mean_s": 0.1}}), figures(1, ())])
    assert (mean.mean, mean.runs) == (0.1, 1)


def test_a_delay_of_0_is_told() -> None:
    (mean,) = means([figures(0, (), message_delays={"unicast": {"mean_s": 0.0}})])
    assert (mean.quantity, mean.mean) == ("unicast messages delay in s", 0)


def test_groups_and_single_nodes_are_apart() -> None:
    nodes = [
        {"name": "groundStation", "tracked_variables": {"heard": 7, "said": 2.5}},
        {"name": "uavs[0]", "tracked_variables": {"heard": 1}},
    ]
    assert quantities([figures(nodes=nodes)]) == {
        "groundStation heard": 7,
        "groundStation said": 2.5,
        "uavs[*] heard": 1,
    }


def test_numbers_may_be_as_large_as_a_float_holds() -> None:
    largest = sys.float_info.max
    (mean,) = means([figures(0, (largest, largest)), figures(1, (largest, largest))])
    assert (mean.mean, mean.low, mean.high) == (largest, largest, largest)


def test_what_is_left_out_is_told_with_the_number_of_values() -> None:
    (mean,) = means([figures(0, (None, 3)), figures(1, ("inf", 5)), figures(2, (None, "inf"))])
    assert (mean.mean, mean.runs, mean.left_out) == (4, 2, "2 nan or None, 2 inf of 6")


def test_nodes_and_runs_without_a_variable_are_told() -> None:
    nodes = [{"name": "uavs[0]", "tracked_variables": {}}, {"name": "uavs[1]", "tracked_variables": {}}]
    (mean,) = means([figures(0, (1, 2)), figures(1, nodes=nodes)])
    assert (mean.mean, mean.runs, mean.left_out) == (1.5, 1, "2 missing of 4")


def test_where_no_node_has_a_number_there_is_no_mean() -> None:
    found = means([figures(0, (1,)), figures(1, (None,), iterations={"jitter": "20ms"})])
    assert [(mean.mean, mean.low, mean.high, mean.runs, mean.left_out) for mean in found] == [
        (1, None, None, 1, ""),
        (None, None, None, 0, "1 nan or None of 1"),
    ]


def test_a_variable_that_is_a_number_nowhere_is_no_quantity() -> None:
    assert means([figures(0, (None, "text"))]) == []


def test_a_group_that_only_some_values_of_variables_have_counts_where_it_is() -> None:
    found = means([figures(0, (1,)), figures(1, (), iterations={"jitter": "20ms"})])
    assert [(mean.iterations, mean.left_out) for mean in found] == [({"jitter": "10ms"}, "")]


def unicast(acknowledged: int, queue_overflow: int) -> dict[str, Any]:
    return {"messages": {"unicast": {"acknowledged": acknowledged, "queue_overflow": queue_overflow}}}


def test_what_was_lost_in_other_runs_of_the_study_is_0() -> None:
    found = means(
        [
            figures(0, (), outcomes=unicast(5, 0)),
            figures(1, (), outcomes=unicast(1, 3), iterations={"jitter": "20ms"}),
        ]
    )
    assert [(mean.quantity, mean.mean) for mean in found] == [
        ("unicast messages acknowledged", 1),
        ("unicast messages queue overflow", 0),
        ("unicast messages acknowledged", 0.25),
        ("unicast messages queue overflow", 0.75),
    ]


def test_what_was_lost_in_no_run_takes_no_room() -> None:
    assert quantities([figures(0, (), outcomes=unicast(5, 0))]) == {"unicast messages acknowledged": 1}


def test_that_no_message_arrived_is_told() -> None:
    assert quantities([figures(0, (), outcomes=unicast(0, 2))]) == {
        "unicast messages acknowledged": 0,
        "unicast messages queue overflow": 1,
    }


def test_runs_without_such_messages_do_not_count() -> None:
    (mean,) = means([figures(0, (), outcomes=unicast(5, 0)), figures(1, (), outcomes=unicast(0, 0))])
    assert (mean.mean, mean.runs) == (1, 1)


def test_other_values_modes_and_configurations_are_apart() -> None:
    changes: list[dict[str, Any]] = [
        {},
        {"iterations": {"jitter": "20ms"}},
        {"iterations": {}},
        {"mode": "prototype"},
        {"config": "Other"},
    ]
    found = means([figures(run, (run,), **change) for run, change in enumerate(changes)])
    assert [(mean.mean, mean.runs, mean.low) for mean in found] == [
        (run, 1, None) for run in range(len(changes))
    ]


def test_the_order_of_variables_does_not_matter() -> None:
    (mean,) = means([figures(0, iterations={"x": 1, "y": 2}), figures(1, iterations={"y": 2, "x": 1})])
    assert mean.runs == 2


def test_runs_of_equal_values_and_different_settings_are_named() -> None:
    results = [figures(3), figures(4, settings_hash="a"), figures(5, settings_hash="b")]
    assert of_different_settings(results) == ("Study-#3", "Study-#4")
    assert of_different_settings(results[1:]) == ("Study-#4", "Study-#5")


def test_settings_may_differ_with_the_values() -> None:
    results = [figures(0, settings_hash="a"), figures(1, settings_hash="b", iterations={"jitter": "20ms"})]
    assert of_different_settings(results) is None


def written(directory: Path, *results: dict[str, Any]) -> list[RunSummary]:
    for each in results:
        (directory / f"{each['run']}.json").write_text(json.dumps(each))
    return read_results(directory)


def test_runs_that_are_another_one_over_again_are_named(tmp_path: Path) -> None:
    results = written(tmp_path, *(result(run, seed=5, fingerprint="f") for run in range(3)))
    assert repeated(results) == [("Study-#0", "Study-#1"), ("Study-#0", "Study-#2")]


@pytest.mark.parametrize(
    "change",
    [
        {"seed": 6},
        {"settings_hash": "b"},
        {"fingerprint": "g"},
        {"heard": (1, 4)},
        {"outcomes": {"messages": {}}},
        {"mode": "prototype"},
        {"iterations": {"jitter": "20ms"}},
    ],
)
def test_a_run_that_differs_is_another_one(tmp_path: Path, change: dict[str, Any]) -> None:
    equal: dict[str, Any] = {"seed": 5, "settings_hash": "a", "fingerprint": "f"}
    assert repeated(written(tmp_path, result(0, **equal), result(1, **{**equal, **change}))) == []


def test_runs_made_with_different_files_of_one_name_are_told() -> None:
    results = [
        figures(0, file_hashes={"a.py": "1", "b.py": "1"}),
        figures(1, file_hashes={"a.py": "1"}, iterations={"jitter": "20ms"}),
        figures(2, file_hashes={"a.py": "1", "b.py": "2"}, mode="prototype"),
    ]
    assert of_different_files(results) == ("Study-#0.integrated", "Study-#2.prototype", "b.py")
    assert of_different_files(results[:2]) is None


def test_other_configurations_and_results_of_before_say_nothing_of_files() -> None:
    results = [
        figures(0, file_hashes={"a.py": "1"}),
        figures(0, file_hashes={"a.py": "2"}, config="Other"),
        figures(1),
    ]
    assert of_different_files(results) is None


def test_means_of_a_folder_by_their_names(tmp_path: Path) -> None:
    delays = {"unicast": {"mean_s": 0.1}}
    (tmp_path / "Study-#0.integrated.json").write_text(json.dumps(result(message_delays=delays)))

    def names(quantities: str | list[str] | None) -> list[str]:
        return [mean.quantity for mean in read_means(str(tmp_path), quantities)]

    both = ["uavs[*] heard", "unicast messages delay in s"]
    assert names(None) == names("*") == names(["unicast*", "uavs[?] heard"]) == both
    assert names("uavs[*] heard") == ["uavs[*] heard"]
    assert names("heard") == names([]) == []


def test_numbers_of_the_run_itself_are_averaged_by_name_only() -> None:
    results = [figures(run, cpu_s=cpu_s, events=7) for run, cpu_s in enumerate([1.0, 3.0])]
    assert [mean.quantity for mean in means(results)] == ["uavs[*] heard"]
    (mean,) = means(results, "cpu_s")
    assert (mean.quantity, mean.runs, mean.mean) == ("cpu_s", 2, 2)
