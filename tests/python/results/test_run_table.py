import sys
from pathlib import Path

import pytest

from gradysim.results import Runs, runs
from gradysim.scenario.errors import ConfigError
from python.study_files import write_result, write_vectors


@pytest.fixture
def study(tmp_path: Path) -> Path:
    """Return two values of a variable in both modes, with two repetitions each."""
    for mode in ("integrated", "prototype"):
        for run in range(4):
            iterations = {"jitter": ("1ms", "10ms")[run // 2], "count": 4}
            write_result(tmp_path, run, (run, run + 1), mode=mode, iterations=iterations, events=run)
    return tmp_path


def numbers(found: Runs) -> list[tuple[str, int]]:
    return [(run.mode, run.run) for run in found]


def test_runs_by_configuration_mode_and_run(study: Path) -> None:
    write_result(study, 9, interrupted=True)
    found = runs(study)
    assert len(found) == 8
    assert numbers(found)[:5] == [*(("integrated", run) for run in range(4)), ("prototype", 0)]
    assert found.variables == ["config", "mode", "run", "seed", "jitter", "count"]
    assert found.values("jitter") == ["1ms", "10ms"]


def test_runs_with_values(study: Path) -> None:
    found = runs(study).where(mode="prototype", jitter="1ms")
    assert numbers(found) == [("prototype", 0), ("prototype", 1)]
    assert numbers(runs(study).where(mode="prototype", run=[0, 3])) == [("prototype", 0), ("prototype", 3)]


@pytest.mark.parametrize("value", [4, "4", "4.0"])
def test_a_number_may_be_a_string(study: Path, value: object) -> None:
    assert len(runs(study).where(count=value)) == 8


def test_an_unknown_variable(study: Path) -> None:
    with pytest.raises(ConfigError) as raised:
        runs(study).where(jiter="1ms")
    assert raised.value.suggestion == "jitter"


def test_a_value_that_no_run_has(study: Path) -> None:
    with pytest.raises(ConfigError) as raised:
        runs(study).where(mode=["integrated", "prototyp"])
    assert raised.value.suggestion == "prototype"


def test_a_row_for_each_run(study: Path) -> None:
    found = runs(study).where(mode="integrated").columns("uavs[*] heard")
    assert found == {
        "config": ["Study"] * 4,
        "mode": ["integrated"] * 4,
        "run": [0, 1, 2, 3],
        "seed": [0, 1, 2, 3],
        "jitter": ["1ms", "1ms", "10ms", "10ms"],
        "count": [4] * 4,
        "uavs[*] heard": [0.5, 1.5, 2.5, 3.5],
    }


def test_all_quantities_by_default(study: Path) -> None:
    assert list(runs(study).columns())[6:] == ["uavs[*] heard", "sim_time_s", "events"]


def test_an_unknown_quantity(study: Path) -> None:
    with pytest.raises(ConfigError) as raised:
        runs(study).columns("uavs heard")
    assert raised.value.suggestion == "uavs[*] heard"


def test_a_row_for_each_node(study: Path) -> None:
    found = runs(study).where(mode="prototype", run=[2, 3]).columns(per="node")
    assert found["node"] == ["uavs[0]", "uavs[1]"] * 2
    assert found["heard"] == [2, 3, 3, 4]
    assert found["run"] == [2, 2, 3, 3]


def test_a_row_for_each_number_over_time(tmp_path: Path) -> None:
    write_result(tmp_path, 0)
    file = write_result(tmp_path, 1)
    heard, place = ("uavs[1]", "protocol", "heard"), ("uavs[1]", "mobility", "positionX")
    write_vectors(file, {heard: {0: 0, 2.5: 7}, place: {0.5: 30}})
    found = runs(tmp_path).columns("heard", per="time")
    assert (found["run"], found["node"], found["quantity"]) == ([1, 1], ["uavs[1]"] * 2, ["heard"] * 2)
    assert (found["time_s"], found["value"]) == ([0, 2.5], [0, 7])
    assert len(runs(tmp_path).columns(per="time")["value"]) == 3


def test_another_kind_of_rows(study: Path) -> None:
    with pytest.raises(ConfigError):
        runs(study).columns(per="message")  # type: ignore[arg-type]


def test_a_variable_with_the_name_of_a_column(tmp_path: Path) -> None:
    write_result(tmp_path, iterations={"mode": "fast", "events": 3})
    assert runs(tmp_path).variables == ["config", "mode", "run", "seed", "$mode", "$events"]
    assert len(runs(tmp_path).where(**{"$mode": "fast"})) == 1


def test_a_tracked_variable_with_the_name_of_a_column(tmp_path: Path) -> None:
    nodes = [{"name": "base", "tracked_variables": {"mode": "idle", "jitter": 5}}]
    write_result(tmp_path, nodes=nodes, iterations={"jitter": "1ms"})
    found = runs(tmp_path).columns(per="node")
    assert (found["$mode"], found["$jitter"], found["jitter"]) == (["idle"], [5], ["1ms"])


@pytest.mark.parametrize(
    ("cells", "column"),
    [
        ([1, 2], [1, 2]),
        ([1, 2.5], [1.0, 2.5]),
        ([1, None], [1, None]),
        ([1, "inf"], [1.0, float("inf")]),
        (["idle", None], ["idle", None]),
        ([1, "idle"], ["1", "idle"]),
        ([[1, 2], "idle"], ["[1, 2]", "idle"]),
    ],
)
def test_cells_of_a_column_have_one_type(tmp_path: Path, cells: list[object], column: list[object]) -> None:
    write_result(tmp_path, heard=cells)
    found = runs(tmp_path).columns(per="node")["heard"]
    assert found == column
    assert [type(cell) for cell in found] == [type(cell) for cell in column]


def test_a_frame_without_pandas_names_the_extra(study: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="`pandas`"):
        runs(study).frame()


def test_a_frame_of_pandas(study: Path) -> None:
    frame = runs(study).frame()
    assert frame.groupby(["mode", "jitter"], sort=False)["uavs[*] heard"].mean().to_list() == [1, 3, 1, 3]
