"""The closed form, at values that follow from it by hand."""

import pytest

from verification.nist import OFDM_RATES_MBPS, received_power_w, success_probability


@pytest.mark.parametrize("rate_mbps", OFDM_RATES_MBPS)
def test_without_noise_everything_arrives(rate_mbps: float) -> None:
    assert success_probability(rate_mbps, 1e4, 1500) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("rate_mbps", OFDM_RATES_MBPS)
def test_below_the_noise_nothing_does(rate_mbps: float) -> None:
    assert success_probability(rate_mbps, 0.1, 100) < 1e-9


@pytest.mark.parametrize(
    ("rate_mbps", "tx_power_w"), [(24.0, 4.1034048e-6), (6.0, 4.710828e-7), (1.0, 8.198825e-7)]
)
def test_the_powers_of_the_reference_runs_give_one_half_at_50_m(rate_mbps: float, tx_power_w: float) -> None:
    snr = received_power_w(tx_power_w, 50.0) / 1e-14
    assert success_probability(rate_mbps, snr, 100) == pytest.approx(0.5, abs=1e-3)


def test_80_81_microwatts_are_85_dbm_below_a_milliwatt_at_50_m() -> None:
    assert received_power_w(80.81e-6, 50.0) == pytest.approx(10**-8.5 * 1e-3, rel=1e-4)
