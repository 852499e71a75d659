from pathlib import Path

import pytest

from gradysim.results import Estimate, Runs, compare_pairs, runs
from gradysim.results.compare import pair_runs, varying_values
from gradysim.scenario.errors import ConfigError
from python.study_files import write_result

HEARD = "uavs[*] heard"


def study(directory: Path, heard: dict[int, float], first_run: int = 0, **changes: object) -> Runs:
    """Write a run for each seed, and return all runs of the directory."""
    for run, (seed, value) in enumerate(heard.items(), first_run):
        write_result(directory, run, (value,), seed=seed, **changes)
    return runs(directory)


def test_runs_of_the_same_seed_are_a_pair(tmp_path: Path) -> None:
    first = study(tmp_path / "a", {0: 1, 1: 2, 2: 3, 7: 100})
    second = study(tmp_path / "b", {2: 5, 1: 3, 0: 1})
    pairs = pair_runs(first, second)
    assert pairs.left_out == (1, 0)
    (change,) = pairs.changes()
    expected = compare_pairs([1, 2, 3], [1, 3, 5])
    assert (change.values, change.quantity, change.pairs) == (
        {"config": "Study", "mode": "integrated"},
        HEARD,
        3,
    )
    assert (change.first, change.second) == (expected.first, expected.second)
    assert change.difference == expected.difference


def test_runs_with_different_values_are_no_pair(tmp_path: Path) -> None:
    for name, more in (("a", 0), ("b", 1)):
        for number, x in enumerate((10, 20)):
            study(tmp_path / name, {0: x, 1: x + more}, 2 * number, iterations={"x": x})
    pairs = pair_runs(runs(tmp_path / "a"), runs(tmp_path / "b"))
    changes = pairs.changes(HEARD)
    assert [(each.values["x"], each.difference and each.difference.mean) for each in changes] == [
        (10, 0.5),
        (20, 0.5),
    ]
    assert varying_values(changes) == ["x"]


def test_a_variable_without_common_values_is_what_is_compared(tmp_path: Path) -> None:
    study(tmp_path, {0: 1}, mode="integrated")
    both = study(tmp_path, {0: 2}, mode="prototype")
    pairs = pair_runs(both.where(mode="integrated"), both.where(mode="prototype"))
    assert pairs.variables == ["config"]
    assert pairs.changes()[0].difference == Estimate(1)


def test_a_quantity_of_one_side_alone_has_no_difference(tmp_path: Path) -> None:
    outcomes = {"messages": {"unicast": {"delivered": 3, "lost": 1}}}
    first = study(tmp_path / "a", {0: 1, 1: 2})
    second = study(tmp_path / "b", {0: 1, 1: 2}, outcomes=outcomes)
    change = pair_runs(first, second).changes("unicast messages delivered")[0]
    assert (change.pairs, change.first, change.difference) == (0, None, None)
    assert change.second == Estimate(0.75, 0.75, 0.75)


def test_an_event_has_exact_intervals_unless_another_value_has_more_than_one(tmp_path: Path) -> None:
    for name in ("a", "b"):
        study(tmp_path / name, {0: 1, 1: 0}, iterations={"x": 1})
    first, second = (runs(tmp_path / name) for name in ("a", "b"))
    (event,) = pair_runs(first, second).changes()
    expected = compare_pairs([1, 0], [1, 0], binary=True)
    assert (event.first, event.difference) == (expected.first, expected.difference)
    second = study(tmp_path / "b", {0: 2, 1: 1}, 2, iterations={"x": 2})
    first = study(tmp_path / "a", {0: 1, 1: 1}, 2, iterations={"x": 2})
    count, _ = pair_runs(first, second).changes()
    assert count.difference == Estimate(0, 0, 0)


def test_losses_are_shares_of_receptions(tmp_path: Path) -> None:
    def outcomes(noise: int, in_air: int) -> dict[str, object]:
        counts = {"delivered": 10 - noise, "noise": noise, "interference": 0, "in_air": in_air}
        return {"frames": {"broadcast": counts, "broadcast overheard": counts}}

    first = study(tmp_path / "a", {0: 1, 1: 1}, outcomes=outcomes(1, 5))
    second = study(tmp_path / "b", {0: 1, 1: 1}, outcomes=outcomes(3, 0))
    (loss,) = pair_runs(first, second).losses()
    assert loss.quantity == "broadcast frames noise"
    assert (loss.first, loss.second) == (Estimate(0.1, 0.1, 0.1), Estimate(0.3, 0.3, 0.3))


def test_runs_without_a_common_seed(tmp_path: Path) -> None:
    first, second = study(tmp_path / "a", {0: 1}), study(tmp_path / "b", {1: 1})
    with pytest.raises(ConfigError) as raised:
        pair_runs(first, second)
    assert all(part in str(raised.value) for part in ("seed", "config", "mode"))


def test_a_run_with_two_partners_is_refused(tmp_path: Path) -> None:
    study(tmp_path / "a", {0: 1}, iterations={"x": 1})
    first = study(tmp_path / "a", {0: 1}, 1, iterations={"x": 2})
    second = study(tmp_path / "b", {0: 1})
    with pytest.raises(ConfigError) as raised:
        pair_runs(first, second)
    assert all(part in raised.value.problem for part in ("Study-#0", "Study-#1", " 0,", "`x`"))
    assert raised.value.expected == "one value: --where x=1"


def test_equal_runs_are_refused(tmp_path: Path) -> None:
    study(tmp_path / "a", {0: 1})
    first = study(tmp_path / "a", {0: 1}, 1)
    with pytest.raises(ConfigError) as raised:
        pair_runs(first, first)
    assert "seed" in raised.value.expected
