import pickle
from typing import Any

import pytest

from gradysim.results.run_summary import RunSummary, in_order


def summary_of(*tracked: dict[str, Any], **changes: Any) -> RunSummary:
    result = {
        "config": "Study",
        "mode": "integrated",
        "run": 0,
        "iterations": {},
        "outcomes": {},
        "nodes": [
            {"name": f"uavs[{index}]", "tracked_variables": each} for index, each in enumerate(tracked)
        ],
    }
    return RunSummary.of({**result, **changes})


def test_of_a_variable_its_mean_is_kept_and_what_is_no_number() -> None:
    summary = summary_of({"x": 1}, {"x": 4}, {"x": "inf"}, {"y": None})
    assert summary.conditions.groups == {"uavs[*]": 4}
    assert summary.numbers == {"uavs[*] x": 2.5}
    assert summary.left_out == {
        "uavs[*] x": {"inf": 1, "missing": 1},
        "uavs[*] y": {"missing": 3, "nan or None": 1},
    }


@pytest.mark.parametrize(("value", "variables"), [("inf", (("uavs[*]", "x"),)), ("text", ()), (None, ())])
def test_a_variable_is_numeric_if_it_is_a_number_at_one_node(
    value: object, variables: tuple[Any, ...]
) -> None:
    assert summary_of({"x": None}, {"x": value}).conditions.variables == variables


def test_a_run_of_many_nodes_takes_no_more_memory() -> None:
    few, many = (len(pickle.dumps(summary_of(*[{"x": 1.5}] * count))) for count in (10, 1000))
    assert many <= few + 10


def test_numbers_of_a_run_by_quantity() -> None:
    delays = {"unicast": {"mean_s": 0.5}}
    run = summary_of({"heard": 1}, {"heard": 3}, events=7, message_delays=delays)
    assert run.numbers == {"uavs[*] heard": 2, "events": 7, "unicast messages delay in s": 0.5}


def test_a_variable_that_no_node_has_as_a_finite_number_is_no_number_of_the_run() -> None:
    assert summary_of({"heard": "inf"}, {"heard": None}).numbers == {}


def test_summaries_are_in_the_order_of_numbers_in_names() -> None:
    runs = [("Field15", 0), ("Field5", 10), ("Field5", 9), ("Field5", 1)]
    ordered = in_order(summary_of({}, config=config, run=run) for config, run in runs)
    assert [(each.config, each.run) for each in ordered] == sorted(
        runs, key=lambda run: (len(run[0]), run[1])
    )
