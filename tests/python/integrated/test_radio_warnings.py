"""Radios that cannot talk to each other, from the .ini file to the text."""

from collections.abc import Callable

import pytest

from gradysim.integrated.network import medium_config
from gradysim.integrated.radio_warnings import radio_warnings
from gradysim.scenario import Scenario

UAVS = "*.uavs[*]"


@pytest.fixture
def warnings(make_scenario: Callable[..., Scenario]) -> Callable[..., list[str]]:
    """`warnings(*settings)`: the texts for two nodes with these settings."""

    def of(*settings: str) -> list[str]:
        scenario = make_scenario("class Tested(Talker): pass", *settings)
        return list(radio_warnings(scenario, medium_config(scenario)))

    return of


def op_mode(nodes: str, mode: str) -> str:
    return f'*.{nodes}.wlan[*].opMode="{mode}"'


def test_stations_on_one_channel_without_a_common_mode_are_told(warnings: Callable[..., list[str]]) -> None:
    (text,) = warnings(op_mode("uavs[0]", "g(erp)"), op_mode("uavs[1]", "b"))
    assert text.startswith(
        f"override {op_mode('uavs[1]', 'b')}: warning: uavs[0] and uavs[1] are on one channel"
    )
    assert '"g(erp)" and "b"' in text


def test_the_line_is_named_where_the_other_mode_is_the_default(warnings: Callable[..., list[str]]) -> None:
    (text,) = warnings(op_mode("uavs[0]", "a"))
    assert text.startswith(f"override {op_mode('uavs[0]', 'a')}: warning: ")


@pytest.mark.parametrize(
    "settings",
    [
        (op_mode("uavs[0]", "b"),),  # the other one is of g(mixed)
        (op_mode("uavs[*]", "a"),),
        (op_mode("uavs[0]", "a"), "*.uavs[0].wlan[*].radio.channelNumber=5"),
        (op_mode("uavs[0]", "a"), '*.radioMedium.typename="UnitDiskRadioMedium"'),
    ],
)
def test_stations_that_hear_each_other_or_nobody_are_not_told(
    warnings: Callable[..., list[str]], settings: tuple[str, ...]
) -> None:
    assert [text for text in warnings(*settings) if "on one channel" in text] == []


CHANNEL_5 = "*.uavs[0].wlan[*].radio.channelNumber=5"


def test_who_shares_no_channel_is_told(warnings: Callable[..., list[str]]) -> None:
    first, second = warnings(CHANNEL_5)
    assert first.startswith(
        f"override {CHANNEL_5}: warning: nobody hears uavs[0]: no other node listens at 2437 MHz"
    )
    assert second.startswith(
        f"override {CHANNEL_5}: warning: nobody hears uavs[1]: no other node listens at 2412 MHz"
    )


def test_who_is_heard_in_one_direction_is_told(warnings: Callable[..., list[str]]) -> None:
    narrow = "*.uavs[0].wlan[*].radio.bandwidth=20MHz"
    (text,) = warnings(narrow)
    assert text.startswith(f"override {narrow}: warning: nobody hears uavs[1]")


def test_another_technology_is_another_channel(warnings: Callable[..., list[str]]) -> None:
    sensor = '*.uavs[0].wlan[*].typename="Ieee802154NarrowbandInterface"'
    assert [text.partition(": no other")[0] for text in warnings(sensor)] == [
        f"override {sensor}: warning: nobody hears uavs[{index}]" for index in (0, 1)
    ]


def test_an_interface_that_shares_its_channel_with_no_other_node_is_told(
    warnings: Callable[..., list[str]],
) -> None:
    channel = "*.uavs[0].wlan[1].radio.channelNumber=5"
    (text,) = warnings("*.uavs[0].numWlanInterfaces=2", channel)
    assert text.startswith(
        f"override {channel}: warning: nobody hears wlan[1] of uavs[0]: no other node listens at 2437 MHz"
    )


def test_no_interface_of_its_own_hears_a_node(warnings: Callable[..., list[str]]) -> None:
    texts = warnings("*.uavs[0].numWlanInterfaces=2", CHANNEL_5)
    assert [text.partition(": no other")[0] for text in texts] == [
        f"override {CHANNEL_5}: warning: nobody hears uavs[{index}]" for index in (0, 1)
    ]


def test_a_wider_listener_hears_what_one_of_the_same_width_does_not(
    warnings: Callable[..., list[str]],
) -> None:
    narrow, wide = "*.uavs[0].wlan[*].radio.bandwidth=10MHz", "*.uavs[1].wlan[*].radio.bandwidth=40MHz"
    (text,) = warnings("*.numUavs=3", narrow, wide)
    assert "nobody hears uavs[1]: no other" in text


@pytest.mark.parametrize(
    "settings",
    [
        ("*.uavs[*].wlan[*].radio.channelNumber=5",),
        ("*.uavs[*].numWlanInterfaces=2", "*.uavs[*].wlan[1].radio.channelNumber=5"),
        (CHANNEL_5, '*.radioMedium.typename="UnitDiskRadioMedium"'),
        ("*.numUavs=1", CHANNEL_5),
    ],
)
def test_who_is_heard_by_one_or_is_alone_is_not_told(
    warnings: Callable[..., list[str]], settings: tuple[str, ...]
) -> None:
    assert [text for text in warnings(*settings) if "nobody hears" in text] == []


NARROWBAND = f'{UAVS}.wlan[*].typename="Ieee802154NarrowbandInterface"'
ACK_WAIT = f"{UAVS}.wlan[*].mac.macAckWaitDuration"


def test_an_ack_that_nobody_waits_for(warnings: Callable[..., list[str]]) -> None:
    (text,) = warnings(NARROWBAND, f"{ACK_WAIT}=500us")
    assert text == (
        f"override {ACK_WAIT}=500us: warning: who waits 500us for an ACK, which ends 544us after the frame (a"
        " sifs, and 352us on the air), repeats frames that have arrived; expected a longer"
        " macAckWaitDuration, or `useMACAcks = false`"
    )


def test_a_rest_that_makes_acks_too_late(warnings: Callable[..., list[str]]) -> None:
    (text,) = warnings(NARROWBAND, f"{UAVS}.wlan[*].mac.sifs=1ms")
    assert "who waits 560us for an ACK, which ends 1352us after the frame" in text


@pytest.mark.parametrize(
    "settings",
    [
        [NARROWBAND, f"{ACK_WAIT}=545us"],
        [NARROWBAND, f"{ACK_WAIT}=500us", f"{UAVS}.wlan[*].mac.useMACAcks=false"],
    ],
    ids=["long enough", "no ACKs"],
)
def test_acks_in_time_or_none_at_all(warnings: Callable[..., list[str]], settings: list[str]) -> None:
    assert warnings(*settings) == []
