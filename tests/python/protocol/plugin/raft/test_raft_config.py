import random

import pytest

from gradysim.protocol.plugin.raft import RaftConfig, RaftMode


def test_defaults():
    assert RaftConfig().to_dict() == {
        "election_timeout_min": 150,
        "election_timeout_max": 300,
        "heartbeat_interval": 50,
        "consensus_variables": {},
        "enable_logging": True,
        "log_level": "INFO",
        "raft_mode": "fault_tolerant",
        "failure_config": (
            "FailureConfig(failure_threshold=3, recovery_threshold=2, detection_interval=2, "
            "timeout=4x50ms=200ms)"
        ),
        "heartbeat_timeout_multiplier": 4,
    }


def test_a_default_configuration_can_be_printed():
    assert str(RaftConfig()).startswith("RaftConfig({")


def test_repr_shows_the_most_important():
    config = RaftConfig().add_consensus_variable("v", int)
    assert (
        repr(config)
        == "RaftConfig(election_timeout=(150, 300), heartbeat_interval=50, consensus_variables=['v'])"
    )


def test_setters_chain():
    config = (
        RaftConfig()
        .set_election_timeout(200, 400)
        .set_heartbeat_interval(60)
        .add_consensus_variable("v", int)
        .add_consensus_variable("w", str)
        .remove_consensus_variable("w")
        .set_logging(False)
        .set_raft_mode(RaftMode.CLASSIC)
    )
    assert config.validate() == []


def test_election_timeouts_are_those_that_were_set():
    config = RaftConfig().set_election_timeout(200, 400)
    assert (config.election_timeout_min_ms, config.election_timeout_max_ms) == (200, 400)


def test_a_variable_can_be_removed():
    config = RaftConfig().add_consensus_variable("v", int).add_consensus_variable("w", str)
    assert config.remove_consensus_variable("w").get_consensus_variables() == {"v": int}


def test_removing_a_variable_that_is_not_there_changes_nothing():
    config = RaftConfig().add_consensus_variable("v", int)
    assert config.remove_consensus_variable("w").get_consensus_variables() == {"v": int}


def test_the_failure_detection_follows_the_heartbeat_interval():
    config = RaftConfig().set_heartbeat_interval(60)
    assert config.get_failure_config().get_timeout_ms() == 240


@pytest.mark.parametrize("bounds", [(300, 300), (301, 300), (-1, 300), (-2, -1), ("1", 2)])
def test_impossible_election_timeouts_are_errors(bounds):
    with pytest.raises(ValueError, match="timeout"):
        RaftConfig().set_election_timeout(*bounds)


@pytest.mark.parametrize("interval", [0, -5, 20, "50"])
def test_impossible_heartbeat_intervals_are_errors(interval):
    with pytest.raises(ValueError, match="ms"):
        RaftConfig().set_heartbeat_interval(interval)


def test_a_refused_heartbeat_interval_changes_nothing():
    config = RaftConfig()
    with pytest.raises(ValueError, match="100 ms"):
        config.set_heartbeat_interval(20)
    assert (config.heartbeat_interval_ms, config.get_failure_config().get_timeout_ms()) == (50, 200)


@pytest.mark.parametrize(("name", "kind"), [("", int), (3, int), ("taken", int), ("v", "int")])
def test_impossible_variables_are_errors(name, kind):
    config = RaftConfig().add_consensus_variable("taken", int)
    with pytest.raises(ValueError, match="variable"):
        config.add_consensus_variable(name, kind)


@pytest.mark.parametrize("mode", ["classic", None, 1])
def test_a_mode_must_be_one(mode):
    with pytest.raises(ValueError, match="mode"):
        RaftConfig().set_raft_mode(mode)


def test_a_log_level_must_be_one():
    with pytest.raises(ValueError, match="'LOUD'"):
        RaftConfig().set_logging(True, "LOUD")


def test_variables_can_be_asked_for():
    config = RaftConfig().add_consensus_variable("v", int)
    assert config.get_consensus_variables() == {"v": int}
    assert (config.has_consensus_variable("v"), config.has_consensus_variable("w")) == (True, False)
    assert (config.get_consensus_variable_type("v"), config.get_consensus_variable_type("w")) == (int, None)


def test_modes_can_be_asked_for():
    config = RaftConfig().set_raft_mode(RaftMode.CLASSIC)
    assert (config.get_raft_mode(), config.is_classic_mode(), config.is_fault_tolerant_mode()) == (
        RaftMode.CLASSIC,
        True,
        False,
    )


@pytest.mark.parametrize("stream", [None, random.Random(1)])
def test_election_timeouts_are_in_range(stream):
    config = RaftConfig().set_election_timeout(10, 12)
    drawn = {config.get_random_election_timeout(stream) for _ in range(100)}
    assert drawn == {10, 11, 12}


def test_validation_finds_what_is_wrong():
    config = RaftConfig().set_election_timeout(40, 300)
    problems = config.validate()
    assert ["heartbeat" in problems[0], "variable" in problems[1], len(problems)] == [True, True, 2]
