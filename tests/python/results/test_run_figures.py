import pickle
from typing import Any

import pytest

from gradysim.results.run_figures import RunFigures, TrackedVariable


def figures(*tracked: dict[str, Any], **changes: Any) -> RunFigures:
    result = {
        "config": "Study",
        "mode": "integrated",
        "run": 0,
        "iterations": {},
        "fates": {},
        "nodes": [
            {"name": f"uavs[{index}]", "tracked_variables": each} for index, each in enumerate(tracked)
        ],
    }
    return RunFigures.of({**result, **changes})


def test_of_a_variable_its_mean_is_kept_and_what_is_no_number() -> None:
    group = figures({"x": 1}, {"x": 4}, {"x": "inf"}, {"y": None}).groups["uavs[*]"]
    assert group.node_count == 4
    assert group.variable("x") == TrackedVariable(2.5, {"inf": 1, "missing": 1})
    assert group.variable("y") == TrackedVariable(None, {"missing": 3, "nan or None": 1})
    assert group.variable("z") == TrackedVariable(None, {"missing": 4})


def test_a_run_of_many_nodes_takes_no_more_memory() -> None:
    few, many = (len(pickle.dumps(figures(*[{"x": 1.5}] * count))) for count in (10, 1000))
    assert many <= few + 10


@pytest.mark.parametrize(
    "change",
    [{"fingerprint": "f"}, {"fates": {"messages": {}}}, {"nodes": []}],
    ids=lambda change: next(iter(change)),
)
def test_what_a_run_computed_differs(change: dict[str, Any]) -> None:
    assert figures({"x": 1}).computed == figures({"x": 1}).computed
    assert figures({"x": 1}, **change).computed != figures({"x": 1}).computed
