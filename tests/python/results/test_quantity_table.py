from pathlib import Path

from gradysim.results import runs
from gradysim.results.quantity_table import QuantityTable, grouped, union, values_of
from python.study_files import write_result

HEARD = "uavs[*] heard"


def test_a_column_has_the_numbers_of_the_runs_that_have_one(tmp_path: Path) -> None:
    for run, heard in enumerate((1, "text", 0)):
        write_result(tmp_path, run, (heard,))
    table = QuantityTable(runs(tmp_path))
    assert sorted(table.numbers(HEARD)) == [0, 1]
    assert table.numbers("unknown") == ()
    assert table.is_binary(HEARD)


def test_a_share_is_not_binary(tmp_path: Path) -> None:
    write_result(tmp_path, 0, (1,), outcomes={"messages": {"unicast": {"acknowledged": 1}}})
    table = QuantityTable(runs(tmp_path))
    share = "unicast messages acknowledged"
    assert table.shown() == {HEARD: "uavs[*]", share: None}
    assert not table.is_binary(share)


def test_groups_keep_the_order_of_the_runs(tmp_path: Path) -> None:
    for run, x in enumerate((2, 1, 2)):
        write_result(tmp_path, run, iterations={"x": x})
    groups = grouped(runs(tmp_path), lambda run: values_of(run, ("x", "y")))
    assert {values: [run.run for run in alike] for values, alike in groups.items()} == {
        (2, None): [0, 2],
        (1, None): [1],
    }
    assert union(([2, 1], [1, 3])) == [2, 1, 3]
