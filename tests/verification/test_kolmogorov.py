"""The Kolmogorov-Smirnov test itself, at tabulated values."""

import pytest

from verification.kolmogorov import ks_distance, ks_p


def test_distance_of_a_few_points_by_hand() -> None:
    assert ks_distance([0.1, 0.4, 0.5], lambda x: x) == pytest.approx(0.5)
    assert ks_distance([0.9, 0.5], lambda x: x) == pytest.approx(0.5)


@pytest.mark.parametrize(("scaled", "p"), [(1.2238, 0.10), (1.3581, 0.05), (1.6276, 0.01), (1.9495, 0.001)])
def test_the_quantiles_of_kolmogorovs_limit(scaled: float, p: float) -> None:
    count = 10**8
    assert ks_p(scaled / count**0.5, count) == pytest.approx(p, rel=1e-3)


def test_a_perfect_sample_is_certain() -> None:
    assert ks_p(0.5 / 1000, 1000) == 1.0
