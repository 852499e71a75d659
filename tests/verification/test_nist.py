"""The closed form, at values that can be computed by hand."""

from collections.abc import Callable

import pytest

from verification.finding import Finding
from verification.nist import OFDM_RATES_MBPS, bit_error, received_power_w, success_probability
from verification.reference_data import rows

NS3_MODES = {"DsssRate1Mbps": (1.0, 22 / 2), "ErpOfdmRate6Mbps": (6.0, 1.0), "ErpOfdmRate24Mbps": (24.0, 1.0)}
"""{ns-3's mode: (rate in Mbps, our SNIR over its: at 1 Mbps it is bandwidth over bitrate, ours is 2)}"""


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


def test_bit_errors_are_those_of_ns3(report: Callable[[Finding], None]) -> None:
    worst = 0.0
    for row in rows("ns3_error_model"):
        rate_mbps, factor = NS3_MODES[row["mode"]]
        snir = 10 ** (float(row["snr_db"]) / 10) * factor
        ours, theirs = (1 - bit_error(rate_mbps, snir)) ** (8 * int(row["psdu_bytes"])), float(row["success"])
        worst = max(worst, abs(ours - theirs) / theirs if theirs else ours)
    report(
        Finding(
            "NIST error model at 1, 6 and 24 Mbps, 100 B and 1000 B, -12 dB to 30 dB, closed form against "
            "ns-3's, at 1 Mbps with its gain of despreading left out (10.4 dB)",
            f"success differs by at most {worst:.1g} of it at {len(rows('ns3_error_model'))} points",
            "1e-9",
            "nothing is random; ns-3 prints ten digits. A test of the engine in C++ has the same points",
            worst <= 1e-9,
        )
    )
