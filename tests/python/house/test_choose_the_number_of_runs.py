"""The commands of docs/how-to/choose-the-number-of-runs.md print what the page shows."""

import re
from collections.abc import Callable
from pathlib import Path
from random import Random
from statistics import fmean

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.cli.until import percent_of_mean
from gradysim.results import estimate

GUIDE = "docs/how-to/choose-the-number-of-runs.md"


@pytest.mark.verify
def test_its_commands_print_what_it_shows(
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
    tmp_path: Path,
) -> None:
    first, *others = code_blocks(GUIDE, "sh")
    new, study = first.split("\n", 1)
    shell(new, tmp_path)
    (tmp_path / "alarm.ini").write_text(code_blocks("docs/how-to/compute-means.md", "ini")[0])
    for number, commands in enumerate((study, *others)):
        shows(GUIDE, shell(commands, tmp_path), number)


def test_its_numbers_of_runs_follow_from_the_interval(root: Path) -> None:
    text = " ".join((root / GUIDE).read_text().split())
    assert "the probability of a failure may still be 52 %" in text
    low = estimate([1] * 5, binary=True).low
    assert low is not None
    assert round(100 * (1 - low)) == 52
    assert "With `< 20%` this takes 20 runs, with `< 5%` it takes 75." in text
    for percent, runs in ((20, 20), (5, 75)):
        found = [percent_of_mean(estimate([0] * count, binary=True)) for count in (runs - 5, runs)]
        assert found[0] >= percent > found[1]
    assert "20 % of a probability of 0.02 takes about 5,000 runs" in text
    assert percent_of_mean(estimate([1] * 100 + [0] * 4900, binary=True)) == pytest.approx(20, rel=0.01)


@pytest.mark.verify
def test_intervals_of_normal_results_hold_as_often_as_it_says(root: Path) -> None:
    text = " ".join((root / GUIDE).read_text().split())
    assert "deviations of 5, 10, 20 and 40 % of the mean" in text
    told, least = re.findall(
        r"takes a mean of ([\d, and]+) runs, .*? in at least (\d+) of 100 studies", text
    )[0]
    random, studies = Random(1), 400
    for deviation, mean_runs in zip((0.05, 0.1, 0.2, 0.4), map(int, re.findall(r"\d+", told)), strict=True):
        counts, held = [], 0
        for _ in range(studies):
            values: list[float] = []
            while not values or percent_of_mean(estimate(values)) >= 5:
                values += [random.gauss(1, deviation) for _ in range(5)]
            found = estimate(values)
            counts.append(len(values))
            held += found.low <= 1 <= found.high
        assert fmean(counts) == pytest.approx(mean_runs, rel=0.1)
        assert held / studies >= int(least) / 100
