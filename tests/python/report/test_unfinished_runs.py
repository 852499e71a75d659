import pytest

from gradysim.report.unfinished_runs import text_of_unfinished


@pytest.mark.parametrize(
    ("numbers", "done", "how", "text"),
    [
        ([0, 1, 2, 3], 0, "failed", "X: run 0 failed, 0 of 4 runs are done, 3 were not begun (1..3)"),
        ([0, 1, 2, 3], 1, "failed", "X: run 1 failed, 1 of 4 runs is done (0), 2 were not begun (2..3)"),
        ([0, 1, 2], 2, "failed", "X: run 2 failed, 2 of 3 runs are done (0..1)"),
        (
            [2, 4, 5, 9],
            2,
            "was interrupted",
            "X: run 5 was interrupted, 2 of 4 runs are done (2,4), 1 was not begun (9)",
        ),
        ([0, 1], 1, "", "X: 1 of 2 runs is done (0), 1 was not begun (1)"),
    ],
)
def test_the_line(numbers: list[int], done: int, how: str, text: str) -> None:
    assert text_of_unfinished("X", numbers, done, how) == text
