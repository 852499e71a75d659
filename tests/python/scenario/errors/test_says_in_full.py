import pytest

from gradysim.scenario.errors.says_in_full import says_in_full


@pytest.mark.parametrize(
    "key",
    [
        "*.uavs[*].mobility.speed",
        "*.uavs[0..3].mobility.speed",
        "*.{u,q}avs[*].mobility.speed",
        "Network.uavs[0].mobility.speed",
        "**.mobility.speed",
        "**[0].mobility.speed",
    ],
)
def test_all_names_behind_the_wildcards(key: str) -> None:
    assert says_in_full(key, "mobility.speed")


@pytest.mark.parametrize(
    "key", ["**", "**.speed", "**.*speed", "**.*.speed", "*.*.*.speed", "**.mobility.s*"]
)
def test_a_name_that_is_left_to_a_wildcard(key: str) -> None:
    assert not says_in_full(key, "mobility.speed")


@pytest.mark.parametrize(
    ("key", "in_full"),
    [
        ("**.power", False),
        ("**.transmitter.power", False),
        ("**.wlan[*].radio.transmitter.power", True),
        ("**.wlan[..3].radio.transmitter.power", True),
    ],
)
def test_indices_hide_no_name(key: str, in_full: bool) -> None:
    assert says_in_full(key, "wlan[1].radio.transmitter.power") == in_full
