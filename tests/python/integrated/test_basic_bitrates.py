"""Acknowledgements at a basic bitrate of the cell."""

from collections.abc import Callable

import pytest

from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError

CELL = """
[General]
sim-time-limit = 4s
**.wlan[*].opMode = "b"
**.wlan[*].bitrate = 11Mbps
*.*[*].mobility.typename = "StationaryMobility"
*.*[*].mobility.telemetryInterval = 0s
*.numSink = 1
*.numSource = 1
*.sink[*].protocol.typename = "SinkProtocol"
*.source[*].protocol.typename = "SaturatingSource"
*.source[*].protocol.payload_bytes = 1472
"""


@pytest.fixture
def received(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., int]:
    """`received(*lines)`: messages that arrive within 3 s."""
    file = tmp_path_factory.mktemp("cell") / "cell.ini"
    file.write_text(CELL)

    def count(*lines: str) -> int:
        (scenario,) = load_scenarios(file, overrides=lines)
        return int(str(run(scenario).nodes[0].tracked_variables["received"]))

    return count


def mean_exchange_us(ack_mbps: float) -> float:
    """Frame with headers, SIFS, ACK, DIFS and 15.5 slots on average (IEEE 802.11-2020, 10.3 and 16.2)."""
    plcp_us, sifs_us, difs_us, slot_us = 192, 10, 50, 20
    return (
        plcp_us
        + (1472 + 28 + 8 + 24 + 4) * 8 / 11
        + sifs_us
        + plcp_us
        + 14 * 8 / ack_mbps
        + difs_us
        + 15.5 * slot_us
    )


@pytest.mark.parametrize(("lines", "ack_mbps"), [((), 11), (("**.mac.basicBitrates = [1Mbps, 2Mbps]",), 2)])
def test_the_throughput_is_that_of_the_arithmetic(
    received: Callable[..., int], lines: tuple[str, ...], ack_mbps: float
) -> None:
    expected = 4e6 / mean_exchange_us(ack_mbps)
    assert received(*lines) == pytest.approx(expected, rel=0.01)


def test_a_bitrate_of_another_operation_mode_is_refused(received: Callable[..., int]) -> None:
    with pytest.raises(ConfigError) as error:
        received("**.mac.basicBitrates = [1Mbps, 6Mbps]")
    assert error.value.key == "**.mac.basicBitrates"


@pytest.mark.parametrize("value", ["2Mbps", "[2]", "[[2Mbps]]", "[0Mbps]", "[2m]", '"2Mbps"'])
def test_what_is_no_list_of_bitrates_is_refused(received: Callable[..., int], value: str) -> None:
    with pytest.raises(ConfigError) as error:
        received(f"**.mac.basicBitrates = {value}")
    assert "[1Mbps, 2Mbps]" in error.value.expected
