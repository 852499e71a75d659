import pytest

from gradysim.protocol.plugin.raft import FailureConfig


def test_defaults():
    config = FailureConfig()
    assert (config.failure_threshold, config.recovery_threshold, config.detection_interval) == (3, 2, 2)
    assert (config.get_timeout_multiplier(), config.get_heartbeat_interval_reference()) == (4, None)


def test_the_timeout_is_a_multiple_of_the_heartbeat_interval():
    config = FailureConfig()
    config.set_heartbeat_interval_reference(50)
    config.set_heartbeat_timeout(6)
    assert config.get_timeout_ms() == config.heartbeat_timeout_ms == 300


def test_without_a_heartbeat_interval_there_is_no_timeout():
    with pytest.raises(ValueError, match="interval"):
        FailureConfig().get_timeout_ms()


@pytest.mark.filterwarnings("error")
def test_an_absolute_timeout_needs_no_heartbeat_interval():
    config = FailureConfig()
    config.set_absolute_timeout(120)
    assert (config.get_timeout_ms(), config.is_using_absolute_timeout()) == (120, True)
    assert config.get_timeout_multiplier() is None


def test_a_very_short_absolute_timeout_warns():
    with pytest.warns(UserWarning, match="49"):
        FailureConfig().set_absolute_timeout(49)


@pytest.mark.filterwarnings("error")
def test_from_50_ms_on_an_absolute_timeout_warns_no_more():
    FailureConfig().set_absolute_timeout(50)


def test_with_an_absolute_timeout_heartbeats_may_be_as_frequent_as_one_likes():
    config = FailureConfig()
    config.set_absolute_timeout(120)
    config.set_heartbeat_interval_reference(1)
    assert config.get_timeout_ms() == 120


def test_a_multiple_replaces_an_absolute_timeout():
    config = FailureConfig()
    config.set_heartbeat_interval_reference(50)
    config.set_absolute_timeout(120)
    config.set_heartbeat_timeout(5)
    assert (config.get_timeout_ms(), config.get_absolute_timeout_ms()) == (250, None)


@pytest.mark.parametrize(
    "setter",
    ["set_failure_threshold", "set_recovery_threshold", "set_detection_interval", "set_heartbeat_timeout"],
)
@pytest.mark.parametrize("value", [0, -1, 1.5, True, "2"])
def test_counts_are_at_least_1(setter, value):
    with pytest.raises(ValueError, match=">= 1"):
        getattr(FailureConfig(), setter)(value)


@pytest.mark.parametrize("setter", ["set_absolute_timeout", "set_heartbeat_interval_reference"])
@pytest.mark.parametrize("value", [0, -1, "2", float("nan")])
def test_times_are_positive(setter, value):
    with pytest.raises(ValueError, match="> 0"):
        getattr(FailureConfig(), setter)(value)


def test_a_multiple_that_is_too_short_is_an_error():
    config = FailureConfig()
    config.set_heartbeat_interval_reference(50)
    with pytest.raises(ValueError, match="100 ms"):
        config.set_heartbeat_timeout(1)


def test_an_interval_whose_multiple_is_too_short_is_an_error():
    with pytest.raises(ValueError, match="100 ms"):
        FailureConfig().set_heartbeat_interval_reference(20)


@pytest.mark.parametrize(
    ("absolute_ms", "reference_ms", "timeout"),
    [(None, None, "4 heartbeat intervals"), (None, 50, "4x50ms=200ms"), (120, None, "120ms")],
)
def test_it_can_be_printed(absolute_ms, reference_ms, timeout):
    config = FailureConfig()
    if absolute_ms is not None:
        config.set_absolute_timeout(absolute_ms)
    if reference_ms is not None:
        config.set_heartbeat_interval_reference(reference_ms)
    assert str(config).endswith(f"timeout={timeout})")
