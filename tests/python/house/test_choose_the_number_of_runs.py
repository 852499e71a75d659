"""The commands of docs/how-to/choose-the-number-of-runs.md print what the page shows."""

from collections.abc import Callable
from pathlib import Path

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
