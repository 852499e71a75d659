"""Safety and liveness over random schedules of all faults.

The rules are checked after every event: see `Rules`. A crash keeps term, vote and log of a node and loses
everything else. `make test` runs an eighth of the schedules, `make test-slow` the others.
`RAFT_SCHEDULES=50000` sets the number of each kind.
"""

import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.plugin.raft import RaftMode
from python.thorough import some

CHUNK = 50
CLASSIC_SCHEDULES = int(os.environ.get("RAFT_SCHEDULES", 1600))
OTHER_SCHEDULES = int(os.environ.get("RAFT_SCHEDULES", 400))


def chunks(count):
    return pytest.mark.parametrize("first_seed", some(range(0, count, CHUNK), count // 8 // CHUNK))


def size(seed):
    return (3, 5, 4, 2, 7)[seed % 5]


@chunks(CLASSIC_SCHEDULES)
def test_classic_mode_is_safe_and_recovers(network_type, first_seed):
    committed = 0
    for seed in range(first_seed, first_seed + CHUNK):
        network = network_type(size(seed), seed)
        network.inject_random_faults(2.0)
        network.check_recovery()
        committed += network.rules.committed_count
    assert committed > CHUNK


@chunks(OTHER_SCHEDULES)
def test_fault_tolerant_mode_has_one_leader_per_term_and_recovers(network_type, first_seed):
    for seed in range(first_seed, first_seed + CHUNK):
        network = network_type(size(seed), seed, RaftMode.FAULT_TOLERANT)
        network.inject_random_faults(2.0)
        network.check_recovery()


@chunks(OTHER_SCHEDULES)
def test_members_that_find_each_other_have_one_leader_per_term(network_type, first_seed):
    for seed in range(first_seed, first_seed + CHUNK):
        network = network_type(size(seed), seed, RaftMode.FAULT_TOLERANT, known=False)
        network.inject_random_faults(1.5)
        network.check_recovery()


@pytest.mark.parametrize("mode", RaftMode)
def test_where_all_hear_each_other_both_modes_keep_what_was_committed(network_type, faults_type, mode):
    """With loss, delay and duplication, but without partitions and crashes: views are nearly the same."""
    for seed in range(20):
        faults = faults_type(loss=0.2, duplication=0.1, delay_s=(0.0, 0.03))
        network = network_type(5, seed, mode, faults, known=seed % 2 == 0, partial=False)
        for number in range(20):
            network.run(0.15)
            network.propose("v", number)
        network.check_recovery()


NODES = 4
NODE_IDS = st.integers(0, NODES - 1)
ACTIONS = st.one_of(
    st.tuples(st.just("run"), st.floats(0.0, 0.6)),
    st.tuples(st.just("partition"), st.sets(NODE_IDS)),
    st.tuples(st.just("crash"), NODE_IDS),
    st.tuples(st.just("restart"), NODE_IDS),
    st.tuples(st.just("play dead"), NODE_IDS),
    st.tuples(st.just("rise"), NODE_IDS),
    st.tuples(st.just("propose"), st.integers(0, 3)),
    st.tuples(st.just("loss"), st.floats(0.0, 0.7)),
    st.tuples(st.just("longest delay"), st.floats(0.0, 0.3)),
)


def act(network, faults_type, action, argument):
    match action:
        case "run":
            network.run(argument)
        case "partition":
            network.partition(argument)
        case "crash":
            network.crash(argument)
        case "restart":
            network.restart(argument)
        case "play dead" | "rise" if argument in network.nodes:
            network.nodes[argument].set_active(action == "rise")
        case "propose":
            network.propose("v", argument)
        case "loss":
            network.faults = faults_type(loss=argument, delay_s=network.faults.delay_s)
        case "longest delay":
            network.faults = faults_type(loss=network.faults.loss, duplication=0.2, delay_s=(0.0, argument))


@given(st.lists(ACTIONS, min_size=5, max_size=60), st.integers(0, 2**16), st.sampled_from(RaftMode))
def test_any_schedule_is_safe_and_recovers(network_type, faults_type, actions, seed, mode):
    network = network_type(NODES, seed, mode)
    network.run(0.5)
    for action, argument in actions:
        act(network, faults_type, action, argument)
    network.check_recovery()
