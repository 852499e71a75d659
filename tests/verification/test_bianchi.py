"""Our implementation of Bianchi's model, against independent figures."""

import pytest

from verification.bianchi import Timing, collision_probability, throughput_bps
from verification.reference_data import Row, rows


def timing_of(row: Row) -> Timing:
    slot, sifs, difs, data, ack = (
        float(row[column]) * 1e-6 for column in ("slot_us", "sifs_us", "difs_us", "Tdata_us", "Tack_us")
    )
    return Timing(slot, data + sifs + ack + difs, data + difs, cw_min=15, doublings=6)


@pytest.mark.parametrize("row", rows("ns3_saturation"), ids=lambda row: f"{row['rate_mbps']}-{row['n']}")
def test_collisions_and_throughput(row: Row) -> None:
    timing, stations = timing_of(row), int(row["n"])
    assert collision_probability(stations, timing) == pytest.approx(float(row["bianchi_inf_p"]), abs=5e-5)
    expected_mbps = float(row["bianchi_inf_mbps_TcDIFS"])
    assert throughput_bps(stations, 8000, timing) / 1e6 == pytest.approx(expected_mbps, abs=1e-4)
