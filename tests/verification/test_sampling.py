import pytest

from verification.sampling import fisher_p, least_p, welch_p


def test_fisher_of_the_lady_tasting_tea() -> None:
    assert fisher_p(3, 4, 1, 4) == pytest.approx(34 / 70)
    assert fisher_p(4, 4, 0, 4) == pytest.approx(2 / 70)


def test_fisher_of_equal_shares_is_one() -> None:
    assert fisher_p(500, 1000, 50, 100) == pytest.approx(1.0)


def test_welch_in_the_table_of_student() -> None:
    """Two samples of 6, equal variance: 10 degrees of freedom, for which the table gives t = 3.169 at 1 %."""
    sample = [-1.0, 1.0, -1.0, 1.0, -1.0, 1.0]
    standard_error = (2 * (6 / 5) / 6) ** 0.5
    assert welch_p(sample, [x + 3.169 * standard_error for x in sample]) == pytest.approx(0.01, rel=1e-3)


def test_bonferroni_divides_the_chance_of_a_false_alarm() -> None:
    assert least_p(5) == pytest.approx(0.002)
