"""The text of a calibration; tests of its figures are in tests/python/integrated."""

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.integrated.calibration import Calibration
from gradysim.report.calibration import text


@pytest.mark.parametrize(("interfaces", "wlan"), [(1, "wlan[*]"), (2, "wlan[0]")])
def test_its_line_sets_the_power_of_the_interface_that_it_is_about(interfaces: int, wlan: str) -> None:
    calibration = Calibration(
        sender="relay",
        sender_interfaces=interfaces,
        receiver="relay",
        range_m=50,
        ratio=0.5,
        message_bytes=50,
        tx_power_w=0.001,
        bitrate_bps=24e6,
        frame_bytes=114,
        snr_at_range=10,
        curve=(),
    )
    assert f"    *.relay.{wlan}.radio.transmitter.power = 1mW" in text(calibration).splitlines()
