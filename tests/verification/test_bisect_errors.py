"""Error rates of `gradysim bisect`, simulated: runs that fail by chance, without a simulator.

docs/how-to/find-what-breaks-a-protocol.md quotes the figures. `make verify` runs them.
"""

from collections import Counter
from collections.abc import Sequence

import pytest

from gradysim.ladder.assertion import Assertion
from gradysim.ladder.bisect import Bisection
from python.ladder.runs_by_chance import RunsByChance

pytestmark = pytest.mark.verify

WORKS = Assertion.parse("works >= 1")
_LEVELS = 8
_TRIES = 200


def verdicts(failing: Sequence[float], *, independent: bool = False) -> Counter[tuple[int | None, bool]]:
    """Return how often each verdict is given: (level that fails, whether it is sure)."""
    return Counter(
        (verdict.fails, verdict.is_sure)
        for seed in range(_TRIES)
        for verdict in [Bisection(RunsByChance(failing, seed, independent=independent), WORKS).find()]
    )


@pytest.mark.parametrize(
    ("levels", "breaks", "ratio", "least"),
    [
        (_LEVELS, 5, 0.1, 0.97),
        (_LEVELS, 5, 0.5, 1),
        (_LEVELS, 5, 1, 1),
        (12, 9, 0.1, 0.9),
    ],
)
def test_a_flaw_is_located(levels: int, breaks: int, ratio: float, least: float) -> None:
    found = verdicts([0] * breaks + [ratio] * (levels - breaks))
    assert found[breaks, True] >= least * _TRIES
    assert found[None, True] == 0
    assert sum(count for (level, is_sure), count in found.items() if is_sure and level != breaks) == 0


def test_a_flaw_at_one_level_only_is_not_passed_over() -> None:
    found = verdicts([0] * 5 + [0.1] + [0] * 2)
    assert found[None, True] <= 0.05 * _TRIES


@pytest.mark.parametrize("ratio", [0.05, 0.2])
def test_levels_that_do_not_differ_are_rarely_told_apart(ratio: float) -> None:
    found = verdicts([ratio] * _LEVELS, independent=True)
    wrong = sum(count for (level, is_sure), count in found.items() if is_sure and level != 0)
    assert wrong <= 0.05 * _TRIES
    assert found[None, True] == 0
