import pytest

from gradysim.protocol.plugin.raft.failure_detection import FailureState, NodeStatus


def test_nodes_are_active_at_first():
    state = FailureState({1, 2})
    assert (state.get_active_nodes(), state.get_failed_nodes(), state.get_all_nodes()) == (
        {1, 2},
        set(),
        {1, 2},
    )


def test_nothing_is_known_about_a_stranger():
    state = FailureState({1})
    assert state.get_node_status(9) is NodeStatus.UNKNOWN
    assert (state.get_statistics(9), state.get_timeout_statistics(9, 1.0), state.is_node_failed(9)) == (
        {},
        {},
        False,
    )


@pytest.mark.parametrize(
    "look_at",
    [
        lambda state: state.record_heartbeat_response(9, 1.0, True),
        lambda state: state.mark_failed(9),
        lambda state: state.reset_node(9),
        lambda state: state.remove_node(9),
    ],
)
def test_a_stranger_remains_one(look_at):
    state = FailureState({1})
    look_at(state)
    assert state.get_all_nodes() == {1}


def test_enough_failures_in_a_row_make_a_node_failed():
    state = FailureState({1})
    for _ in range(2):
        state.record_heartbeat_response(1, 0.0, False)
    assert (state.check_node_failure(1, 3), state.check_node_failure(1, 2)) == (False, True)
    assert state.is_node_failed(1)


def test_becoming_failed_is_news_once():
    state = FailureState({1})
    state.record_heartbeat_response(1, 0.0, False)
    assert [state.check_node_failure(1, 1) for _ in range(2)] == [True, False]


def test_an_answer_ends_a_row_of_failures():
    state = FailureState({1})
    for success in (False, True, False):
        state.record_heartbeat_response(1, 0.0, success)
    assert not state.check_node_failure(1, 2)


def test_enough_answers_in_a_row_make_a_node_active():
    state = FailureState({1})
    state.record_heartbeat_response(1, 0.0, False)
    state.check_node_failure(1, 1)
    state.record_heartbeat_response(1, 0.1, True)
    first = state.check_node_recovery(1, 2)
    state.record_heartbeat_response(1, 0.2, True)
    assert (first, state.check_node_recovery(1, 2)) == (False, True)
    assert state.get_node_status(1) is NodeStatus.ACTIVE


def test_silence_counts_from_the_last_answer():
    state = FailureState({1})
    state.record_heartbeat_response(1, 1.0, True)
    looks = [state.check_node_failure_with_timeout(1, 1, 200, time_s) for time_s in (1.1, 1.2, 1.3)]
    assert looks == [False, False, True]


def test_silence_of_a_node_that_never_answered_counts_from_the_first_look():
    state = FailureState({1})
    looks = [state.check_node_failure_with_timeout(1, 1, 200, time_s) for time_s in (5.0, 5.1, 5.3)]
    assert looks == [False, False, True]


def test_nodes_come_and_go():
    state = FailureState({1})
    state.add_node(2)
    state.remove_node(1)
    state.remove_node(7)
    assert state.get_all_nodes() == {2}


@pytest.mark.parametrize("again", ["add_node", "reset_node"])
def test_adding_keeps_and_resetting_forgets(again):
    state = FailureState({1})
    state.mark_failed(1)
    getattr(state, again)(1)
    assert state.is_node_failed(1) is (again == "add_node")


def test_statistics():
    state = FailureState({1})
    state.record_heartbeat_response(1, 2.0, True)
    assert state.get_statistics(1) == {
        "consecutive_failures": 0,
        "consecutive_successes": 1,
        "status": "active",
    }
    assert state.get_timeout_statistics(1, 2.5) == {
        "last_response_timestamp": 2.0,
        "time_since_response_ms": 500.0,
        "consecutive_failures": 0,
        "consecutive_successes": 1,
    }
