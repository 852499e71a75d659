"""Runs by another executor, and the line about missing runs."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import pytest

from gradysim.cli.errors import FAILED, INTERRUPTED, LOCKED, OK
from gradysim.cli.options import RunOptions
from gradysim.cli.run import run_file
from gradysim.cli.run_all import text_of_unfinished


def test_runs_under_way_are_neither_done_nor_not_begun() -> None:
    line = text_of_unfinished("X", range(5), {0: OK}, under_way=[1, 2])
    assert line == "X: 1 of 5 runs is done (0), 2 were under way (1..2), 2 were not begun (3..4)"


@pytest.mark.parametrize(
    ("numbers", "codes", "text"),
    [
        (range(4), {0: FAILED}, "X: run 0 failed, 0 of 4 runs are done, 3 were not begun (1..3)"),
        (range(4), {0: OK, 1: FAILED}, "X: run 1 failed, 1 of 4 runs is done (0), 2 were not begun (2..3)"),
        (range(3), {0: OK, 1: OK, 2: FAILED}, "X: run 2 failed, 2 of 3 runs are done (0..1)"),
        (
            [2, 4, 5, 9],
            {2: OK, 4: OK, 5: INTERRUPTED},
            "X: run 5 was interrupted, 2 of 4 runs are done (2,4), 1 was not begun (9)",
        ),
        (range(2), {0: OK}, "X: 1 of 2 runs is done (0), 1 was not begun (1)"),
        (
            range(4),
            {1: OK, 0: FAILED, 2: INTERRUPTED},
            "X: run 0 failed, run 2 was interrupted, 1 of 4 runs is done (1), 1 was not begun (3)",
        ),
        (range(2), {0: OK, 1: LOCKED}, "X: run 1 was left out, 1 of 2 runs is done (0)"),
    ],
)
def test_the_line(numbers: Sequence[int], codes: dict[int, int], text: str) -> None:
    assert text_of_unfinished("X", numbers, codes) == text


def test_the_executor_is_an_argument(folder, capsys):
    options = RunOptions(mode="prototype", quiet=True, result_dir=folder / "out")
    with ThreadPoolExecutor(1) as executor:
        assert run_file(folder / "test.ini", options, executor) == 0
        assert executor.submit(int).result() == 0
    assert len(list((folder / "out").iterdir())) == 3
