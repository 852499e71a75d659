import itertools
from pathlib import Path

import pytest
from matplotlib.axes import Axes

from gradysim import plots
from gradysim.plots.outcomes import outcomes_numbers
from gradysim.results import Runs, estimate, runs
from gradysim.scenario.errors import ConfigError
from python.study_files import write_result


@pytest.fixture
def losses(tmp_path: Path) -> Runs:
    """Return two runs of one value, and one run of another."""
    for run, (jitter, delivered, noise, far) in enumerate([(1, 6, 2, 8), (1, 3, 1, 12), (2, 10, 0, 6)]):
        counts = {"delivered": delivered, "noise": noise, "below_sensitivity": far, "in_air": 5}
        outcomes = {"frames": {"broadcast": counts}}
        write_result(tmp_path, run, iterations={"jitter": jitter}, outcomes=outcomes)
    return runs(tmp_path)


def test_shares_of_what_was_decided(losses: Runs) -> None:
    numbers = outcomes_numbers(losses, y="broadcast frames", x="jitter")
    shares = {str(curve.values["outcome"]): curve.columns["mean"] for curve in numbers.curves}
    of_1 = estimate([6 / 16, 3 / 16])
    assert list(shares) == ["delivered", "noise", "below sensitivity"]
    assert shares["delivered"] == [of_1.mean, 10 / 16]
    assert [sum(each) for each in zip(*shares.values(), strict=True)] == pytest.approx([1, 1])
    assert numbers.curves[0].columns["low"] == [of_1.low, None]
    assert numbers.curves[0].columns["high"] == [of_1.high, None]
    assert numbers.curves[0].columns["jitter"] == [1, 2]


def test_outcomes_that_are_left_out(losses: Runs) -> None:
    numbers = outcomes_numbers(losses, y="broadcast frames", x="jitter", omit=["below sensitivity"])
    assert [curve.values["outcome"] for curve in numbers.curves] == ["delivered", "noise"]
    assert numbers.curves[0].columns["mean"] == [0.75, 1]


def test_a_bar_for_each_curve_without_an_axis(losses: Runs) -> None:
    numbers = outcomes_numbers(losses, y="broadcast frames")
    assert numbers.categories == ["jitter = 1", "jitter = 2"]


def test_a_kind_that_is_not_there(losses: Runs) -> None:
    with pytest.raises(ConfigError) as raised:
        outcomes_numbers(losses, y="broadcast frame")
    assert raised.value.suggestion == "broadcast frames"


def test_bars_are_stacked(axes: Axes, losses: Runs) -> None:
    assert plots.outcomes(axes, losses, y="broadcast frames", x="jitter") is axes
    stacks = [[(bar.get_y(), bar.get_height()) for bar in container] for container in axes.containers]
    for below, above in itertools.pairwise(stacks):
        assert [y for y, _ in above] == pytest.approx([y + height for y, height in below])
    assert [label.get_text() for label in axes.get_xticklabels()] == ["1", "2"]
    legend = [text.get_text() for text in axes.get_legend().get_texts()]
    assert legend == ["below sensitivity", "noise", "delivered"]


def test_outcomes_have_different_looks(axes: Axes, tmp_path: Path) -> None:
    names = [f"outcome {number}" for number in range(14)]
    write_result(tmp_path, outcomes={"frames": {"ack": dict.fromkeys(names, 1)}})
    plots.outcomes(axes, runs(tmp_path), y="ack frames")
    looks = {(bar.patches[0].get_facecolor(), bar.patches[0].get_hatch()) for bar in axes.containers}
    assert len(looks) == len(names)
