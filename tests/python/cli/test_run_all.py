"""Runs by another executor, and the line about missing runs."""

from concurrent.futures import ThreadPoolExecutor

import pytest

from gradysim.cli.options import RunOptions
from gradysim.cli.run import run_file
from gradysim.cli.run_all import text_of_unfinished


def test_runs_under_way_are_neither_done_nor_not_begun() -> None:
    line = text_of_unfinished("X", [0], {}, [3, 4], under_way=[1, 2])
    assert line == "X: 1 of 5 runs is done (0), 2 were under way (1..2), 2 were not begun (3..4)"


@pytest.mark.parametrize(
    ("done", "ended", "left", "text"),
    [
        ([], {0: "failed"}, [1, 2, 3], "X: run 0 failed, 0 of 4 runs are done, 3 were not begun (1..3)"),
        ([0], {1: "failed"}, [2, 3], "X: run 1 failed, 1 of 4 runs is done (0), 2 were not begun (2..3)"),
        ([0, 1], {2: "failed"}, [], "X: run 2 failed, 2 of 3 runs are done (0..1)"),
        (
            [2, 4],
            {5: "was interrupted"},
            [9],
            "X: run 5 was interrupted, 2 of 4 runs are done (2,4), 1 was not begun (9)",
        ),
        ([0], {}, [1], "X: 1 of 2 runs is done (0), 1 was not begun (1)"),
        (
            [1],
            {0: "failed", 2: "was interrupted"},
            [3],
            "X: run 0 failed, run 2 was interrupted, 1 of 4 runs is done (1), 1 was not begun (3)",
        ),
    ],
)
def test_the_line(done: list[int], ended: dict[int, str], left: list[int], text: str) -> None:
    assert text_of_unfinished("X", done, ended, left) == text


def test_the_executor_is_an_argument(folder, capsys):
    options = RunOptions(mode="prototype", quiet=True, result_dir=folder / "out")
    with ThreadPoolExecutor(1) as executor:
        assert run_file(folder / "test.ini", options, executor) == 0
        assert executor.submit(int).result() == 0
    assert len(list((folder / "out").iterdir())) == 3
