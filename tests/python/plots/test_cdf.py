from pathlib import Path
from typing import Any

import pytest
from matplotlib.axes import Axes

from gradysim import plots
from gradysim.plots.cdf import cdf_numbers
from gradysim.results import estimate, runs
from gradysim.scenario.errors import ConfigError
from python.study_files import write_result

DELAY = "unicast messages delay in s"


def with_delays(directory: Path, run: int, times_s: list[float], shares: list[float]) -> None:
    delays: dict[str, Any] = {"mean_s": 1.0, "cumulative": {"time_s": times_s, "share": shares}}
    write_result(directory, run, message_delays={"unicast": delays})


def test_delays_of_messages_are_the_mean_of_the_runs(tmp_path: Path) -> None:
    with_delays(tmp_path, 0, [1.0, 3.0], [0.4, 1.0])
    with_delays(tmp_path, 1, [2.0, 3.0], [0.5, 1.0])
    (curve,) = cdf_numbers(runs(tmp_path), y=DELAY).curves
    rows = [estimate(shares) for shares in ([0.4, 0], [0.4, 0.5], [1, 1])]
    assert curve.columns == {
        DELAY: [1, 2, 3],
        "runs": [2, 2, 2],
        "mean": [row.mean for row in rows],
        "low": [row.low for row in rows],
        "high": [row.high for row in rows],
    }


def test_a_tracked_variable_is_distributed_over_the_nodes_of_a_run(tmp_path: Path) -> None:
    write_result(tmp_path, 0, (5, 1, 5, "text"))
    (curve,) = cdf_numbers(runs(tmp_path), y="uavs[*] heard").curves
    assert curve.x == [1, 5]
    assert curve.columns["mean"] == [pytest.approx(1 / 3), 1]
    assert curve.columns["low"] == curve.columns["high"] == [None, None]


@pytest.mark.parametrize("quantity", ["uavs[*] heard", "events"])
def test_a_number_for_each_run_is_distributed_over_runs(tmp_path: Path, quantity: str) -> None:
    for run in range(4):
        write_result(tmp_path, run, (run,), events=run)
    numbers = cdf_numbers(runs(tmp_path), y=quantity)
    (curve,) = numbers.curves
    assert curve.columns == {
        quantity: [0, 1, 2, 3],
        "runs": [4] * 4,
        "mean": [0.25, 0.5, 0.75, 1],
        "low": [None] * 4,
        "high": [None] * 4,
    }
    assert "n = 4 runs" in numbers.caption


def test_results_without_distributions(tmp_path: Path) -> None:
    write_result(tmp_path, message_delays={"unicast": {"mean_s": 1.0}})
    with pytest.raises(ConfigError, match="again"):
        cdf_numbers(runs(tmp_path), y=DELAY)


def test_what_is_drawn(axes: Axes, tmp_path: Path) -> None:
    write_result(tmp_path, 0, (5, 1))
    assert plots.cdf(axes, runs(tmp_path), y="uavs[*] heard") is axes
    (line,) = axes.lines
    assert line.get_xydata().tolist() == [[1, 0], [1, 0.5], [5, 1]]
    assert line.get_drawstyle() == "steps-post"
    assert axes.get_ylim() == (0, 1.02)
