import pytest

from gradysim.scenario.value.kinds import coordinate, place
from gradysim.scenario.value.safe_draws import is_safe


@pytest.mark.parametrize("text", ["uniform(0m, 1km)", " uniform ( -5km,5m ) ", "50m * parentIndex()", "3m"])
def test_what_is_right_with_one_seed_is_so_with_all(text: str) -> None:
    assert is_safe(text, place())


@pytest.mark.parametrize(
    "text",
    [
        "uniform(0m, 1e12km)",
        "uniform(0m, index * 1m)",
        "uniform(0m, 1s)",
        "uniform(0m, uniform(0m, 1m))",
        "uniform(0m, 1m) + uniform(0m, 1m)",
        "1m / uniform(0, 1)",
        "normal(0m, 1m)",
        'select(intuniform(0, 1), 3m, "x")',
    ],
)
def test_others_may_be_wrong_with_another_seed(text: str) -> None:
    assert not is_safe(text, place())


def test_where_other_lines_count_all_seeds_have_to_be_tried() -> None:
    assert not is_safe(
        "uniform(0m, 1km)", coordinate()
    )  # as for an obstacle, which has to be higher than low
