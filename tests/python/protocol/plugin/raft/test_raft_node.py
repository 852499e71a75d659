"""The state machine: starting and stopping, followers, candidates and leaders."""

import json
import logging

import pytest

from gradysim.protocol.plugin.raft import RaftConfig, RaftMode, RaftState
from gradysim.protocol.plugin.raft.raft_message import AppendEntries, DiscoveryHeartbeatResponse, RequestVote
from gradysim.protocol.plugin.raft.raft_node import ELECTION_TIMER, HEARTBEAT_TIMER, RaftNode
from gradysim.protocol.plugin.raft.raft_state import RaftLog
from python.protocol.plugin.raft.bare_provider import BareProvider
from python.protocol.plugin.raft.term_owner import owner_of

BOTH_MODES = pytest.mark.parametrize("mode", RaftMode)


def test_members_find_each_other(network_type):
    network = network_type(5, 1, known=False)
    network.elect()
    network.run(1.0)
    assert {node.membership.known for node in network.nodes.values()} == {frozenset(range(5))}


def test_strangers_are_not_heard(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    leader.handle_message(AppendEntries(10**6, 77, {}, 0).to_json())
    assert network.leader is leader


def test_other_clusters_are_not_heard(network_type):
    network = network_type(4, 1, RaftMode.FAULT_TOLERANT)
    for node in network.nodes.values():
        node.membership.cluster_id = node.node_id % 2
    network.run(2.0)
    assert {node.node_id % 2 for node in network.leaders} == {0, 1}


def test_what_is_no_message_is_ignored(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    for text in ("", "garbage", "{}", '{"type": "RequestVote"}', "\u0000", "[" * 50):
        leader.handle_message(text)
    assert network.leader is leader


def test_who_plays_dead_is_silent(network_type):
    network = network_type(1, 1, known=False)
    network.nodes[0].set_active(False)
    network.run(2.0)
    network.nodes[0].send_text("text")
    assert (network.sent, network.nodes[0].transport.pending_timers) == (0, set())


@pytest.mark.parametrize("leave", [lambda node: node.stop(), lambda node: node.set_active(False)])
def test_who_is_stopped_or_plays_dead_is_deaf(network_type, leave):
    network = network_type(3, 1)
    leader = network.elect()
    node = network.nodes[(leader.node_id + 1) % 3]
    leave(node)
    node.handle_message(AppendEntries(10**6, leader.node_id, {}, 0).to_json())
    assert (node.persistent.current_term, node.leader_id) == (leader.persistent.current_term, None)


def test_a_leader_that_plays_dead_gives_up_its_term(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    term = leader.persistent.current_term
    leader.set_active(False)
    assert (leader.state, leader.persistent.current_term) == (RaftState.FOLLOWER, term + 1)
    assert not leader.propose("v", 1)


def test_a_follower_that_plays_dead_keeps_its_term(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    follower = network.nodes[(leader.node_id + 1) % 3]
    for active in (False, True):
        follower.set_active(active)
    assert follower.persistent.current_term == leader.persistent.current_term


def test_who_rises_again_waits_for_a_leader_and_then_stands(network_type):
    node = network_type(3, 1).nodes[0]
    node.set_active(False)
    node.set_active(True)
    assert node.transport.pending_timers == {ELECTION_TIMER}


def test_who_rises_again_takes_part(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    leader.set_active(False)
    network.run(2.0)
    leader.set_active(True)
    network.elect().propose("v", 42)
    assert network.run(1.0, until=lambda: network.agree_on("v", 42))


def test_who_was_stopped_goes_on_where_it_was(network_type):
    network = network_type(3, 1)
    node = network.elect()
    node.propose("v", 42)
    network.run(0.2)
    node.stop()
    network.run(2.0)
    values = dict(node.persistent.log.values)
    node.start()
    network.elect()
    assert (values, network.agree_on("v", 42)) == ({"v": 42}, True)


def test_no_two_nodes_send_at_the_same_time_for_long(network_type, faults_type):
    """Without a delay all followers receive a heartbeat at the same instant."""
    network = network_type(9, 1, faults=faults_type(delay_s=(0.0, 0.0)))
    network.elect()
    instants = []
    transmit = network.transmit
    network.transmit = lambda *arguments: (instants.append(network.now_s), transmit(*arguments))
    network.run(2.0)
    assert len(instants) == len(set(instants)) > 300


# ---- all roles: terms and majorities ----


@pytest.mark.parametrize(
    ("nodes", "electorate", "is_majority"),
    [
        ({0, 1}, {0, 1, 2}, True),
        ({0, 1}, {0, 1, 2, 3}, False),
        ({0, 1, 2}, {0, 1, 2, 3}, True),
        ({0, 8, 9}, {0, 1, 2}, False),  # nodes outside of the cluster do not count
    ],
)
def test_a_majority_is_more_than_half_of_the_electorate(network_type, nodes, electorate, is_majority):
    node = network_type(3, 1).nodes[0]
    assert node.has_majority(nodes, frozenset(electorate)) == is_majority


@pytest.mark.parametrize("known", [True, False])
def test_one_alone_is_a_majority_only_if_it_was_set_to_be_alone(network_type, known):
    node = network_type(1, 1, known=known).nodes[0]
    assert node.has_majority({0}, frozenset({0})) == known


def follower_of(network):
    leader = network.elect()
    return next(node for node in network.nodes.values() if node is not leader)


def test_in_a_higher_term_vote_and_leader_are_forgotten(network_type):
    node = follower_of(network_type(3, 1))
    term = node.persistent.current_term
    node.persistent.voted_for = node.leader_id
    node.adopt_term(term + 1)
    assert node.persistent.current_term == term + 1
    assert (node.persistent.voted_for, node.leader_id, node.hears_leader()) == (None, None, False)


@pytest.mark.parametrize("step", [0, -1])
def test_a_term_that_is_not_higher_changes_nothing(network_type, step):
    """A forgotten vote could be given twice."""
    node = follower_of(network_type(3, 1))
    term, leader = node.persistent.current_term, node.leader_id
    node.persistent.voted_for = leader
    node.adopt_term(term + step)
    assert (node.persistent.current_term, node.persistent.voted_for, node.leader_id) == (term, leader, leader)


def test_a_leader_that_hears_of_a_higher_term_waits_for_another_one(network_type):
    leader = network_type(3, 1).elect()
    leader.adopt_term(leader.persistent.current_term + 1)
    assert (leader.state, leader.leadership) == (RaftState.FOLLOWER, None)
    assert HEARTBEAT_TIMER not in leader.transport.pending_timers
    assert ELECTION_TIMER in leader.transport.pending_timers


@pytest.mark.parametrize(("silence_s", "is_heard"), [(0.149, True), (0.151, False)])
def test_a_leader_is_heard_for_the_shortest_election_timeout(network_type, silence_s, is_heard):
    network = network_type(3, 1)
    node = follower_of(network)
    node.leader_heard_s = network.now_s
    network.now_s += silence_s
    assert node.hears_leader() == is_heard


def test_in_fault_tolerant_mode_those_decide_that_are_active(network_type):
    network = network_type(3, 1, RaftMode.FAULT_TOLERANT)
    leader = network.elect()
    away = next(node_id for node_id in network.nodes if node_id != leader.node_id)
    network.run(1.0)
    assert leader.electorate() == {0, 1, 2}
    network.crash(away)
    network.run(2.0)
    assert leader.electorate() == {0, 1, 2} - {away}


def test_lines_below_the_level_that_is_wanted_are_not_logged(network_type, caplog):
    network = network_type(1, 1)
    network.config.set_logging(True, "WARNING")
    caplog.set_level(logging.DEBUG)
    for level in (logging.INFO, logging.WARNING):
        network.nodes[0].log(level, "term %d", level)
    assert caplog.messages == ["Raft node 0: term 30"]


# ---- followers ----


def test_who_was_away_catches_up(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    away = next(node_id for node_id in network.nodes if node_id != leader.node_id)
    network.crash(away)
    for number in range(50):
        leader.propose("v", number)
        network.run(0.06)
    network.restart(away)
    assert network.run(1.0, until=lambda: network.agree_on("v", 49))


def test_a_stale_leader_is_refused(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    follower = next(node for node in network.nodes.values() if node is not leader)
    stale = next(node for node in network.nodes.values() if node not in (leader, follower))
    follower.handle_message(AppendEntries(0, stale.node_id, {"v": 13}, 0).to_json())
    assert follower.leader_id == leader.node_id


@pytest.mark.parametrize(("mode", "value"), [(RaftMode.CLASSIC, 1), (RaftMode.FAULT_TOLERANT, 2)])
def test_only_in_classic_mode_what_is_committed_is_kept_against_a_leader(network_type, mode, value):
    node = network_type(3, 1, mode).nodes[0]
    node.persistent.log = RaftLog(base_index=5, base_term=2, values={"v": 1})
    leader = AppendEntries(9, 1, {"v": 2}, 5, commit_index=5, commit_term=3)
    node.handle_message(leader.to_json())
    assert node.persistent.log.values == {"v": value}


def test_who_hears_a_leader_does_not_vote_for_another(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    follower, other = (node for node in network.nodes.values() if node is not leader)
    follower.handle_message(RequestVote(10**6, other.node_id, 10**6, 10**6).to_json())
    assert follower.persistent.current_term == leader.persistent.current_term


@pytest.mark.parametrize(("known", "granted"), [([0, 1, 2], True), ([1], False), (None, True)])
def test_while_members_are_found_who_knows_fewer_gets_no_vote(network_type, known, granted):
    network = network_type(3, 1, known=False)
    network.elect()
    network.run(1.0)
    voter = network.nodes[0]
    voter.adopt_term(10**6)  # its leader is unknown
    voter.handle_message(RequestVote(10**6, 1, 10**6, 10**6, known_nodes=known).to_json())
    assert (voter.persistent.voted_for == 1) is granted


# ---- candidates ----


@BOTH_MODES
@pytest.mark.parametrize("known", [True, False])
def test_a_leader_is_elected(network_type, mode, known):
    network = network_type(5, 1, mode, known=known)
    leader = network.elect(within_s=1.0)
    assert owner_of(leader.persistent.current_term) == leader.node_id


@BOTH_MODES
def test_who_has_heard_all_members_stands_at_once(network_type, mode):
    network = network_type(3, 1, mode)
    network.nodes[0].handle_timer(ELECTION_TIMER)
    # All rounds of discovery take 200 ms; two answers to a broadcast take 50 ms at most each.
    assert network.run(0.1, until=lambda: network.leader is network.nodes[0])


def test_a_candidate_without_votes_does_not_lead(network_type):
    network = network_type(3, 1)
    transmit = network.transmit
    network.transmit = lambda source, message, destination: (
        None if '"RequestVote"' in message else transmit(source, message, destination)
    )
    assert network.run(1.0, until=lambda: any(map(is_candidate, network.nodes.values())))
    network.run(2.0)
    assert network.leaders == []


def is_candidate(node):
    return node.state is RaftState.CANDIDATE


def test_a_leader_heeds_no_election_timeout(network_type):
    leader = network_type(3, 1).elect()
    leader.handle_timer(ELECTION_TIMER)
    assert leader.leader_id == leader.node_id


@BOTH_MODES
def test_after_the_leader_crashes_there_is_another(network_type, mode):
    network = network_type(5, 1, mode)
    first = network.elect()
    first.propose("v", 42)
    network.run(0.2)
    network.crash(first.node_id)
    second = network.elect()
    assert (second.node_id != first.node_id, second.persistent.log.values) == (True, {"v": 42})


def test_in_fault_tolerant_mode_the_last_but_one_failure_still_leaves_a_leader(network_type):
    network = network_type(5, 1, RaftMode.FAULT_TOLERANT)
    network.elect()
    for node_id in (0, 1, 2):
        network.crash(node_id)
        network.run(2.0)
    assert network.elect().propose("v", 42)


def test_in_fault_tolerant_mode_the_last_node_does_not_lead(network_type):
    network = network_type(3, 1, RaftMode.FAULT_TOLERANT)
    network.elect()
    network.crash(0)
    network.crash(1)
    network.run(5.0)
    assert network.leaders == []


@BOTH_MODES
def test_a_node_that_was_set_to_be_alone_leads(network_type, mode):
    network = network_type(1, 1, mode)
    network.rules.check = lambda node: None  # the rules check entries before they are committed
    assert network.elect().propose("v", 42)
    assert network.agree_on("v", 42)


def test_a_node_that_was_set_to_be_alone_asks_nobody_for_votes(network_type):
    network = network_type(1, 1)
    sent = []
    network.transmit = lambda source, message, destination: sent.append(json.loads(message)["type"])
    network.nodes[0].handle_timer(ELECTION_TIMER)
    assert sent == ["AppendEntries"]


@BOTH_MODES
def test_a_node_that_finds_nobody_does_not_lead(network_type, mode):
    network = network_type(1, 1, mode, known=False)
    network.run(5.0)
    assert network.leaders == []


def test_a_lonely_node_does_not_raise_its_term(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    lonely = next(node for node in network.nodes.values() if node is not leader)
    network.partition([lonely.node_id])
    network.run(10.0)
    assert lonely.persistent.current_term == leader.persistent.current_term
    network.partition()
    network.run(1.0)
    assert network.leader is leader


@BOTH_MODES
@pytest.mark.parametrize("known", [True, False])
def test_long_delays_need_long_timeouts_only(network_type, faults_type, mode, known):
    network = network_type(5, 1, mode, faults_type(delay_s=(0.1, 0.1)), known=known)
    network.config.set_election_timeout(1000, 2000).set_heartbeat_interval(300)
    leader = network.elect(within_s=20.0)
    assert leader.propose("v", 42)
    assert network.run(1.0, until=lambda: network.agree_on("v", 42))


# ---- leaders ----


@BOTH_MODES
def test_a_leader_stays_while_all_is_well(network_type, mode):
    network = network_type(5, 1, mode)
    network.elect()
    network.run(20.0)
    assert len(network.rules.leaders) == 1


@BOTH_MODES
def test_a_leader_stays_with_a_fifth_of_the_messages_lost(network_type, faults_type, mode):
    network = network_type(9, 1, mode, faults_type(loss=0.2, delay_s=(0.01, 0.01)))
    network.elect()
    network.run(20.0)
    assert len(network.rules.leaders) == 1


@BOTH_MODES
def test_a_proposal_is_committed_everywhere(network_type, mode):
    network = network_type(5, 1, mode)
    assert network.elect().propose("v", 42)
    assert network.run(0.2, until=lambda: network.agree_on("v", 42))


def test_a_proposal_does_not_wait_for_the_next_heartbeat(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    before = network.sent
    leader.propose("v", 42)
    assert network.sent == before + 1


def test_only_a_leader_takes_proposals(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    assert [node.propose("v", 1) for node in network.nodes.values() if node is not leader] == [False, False]


def test_proposing_what_holds_adds_nothing(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    leader.propose("v", 1)
    network.run(0.2)
    before = leader.persistent.log.last_index
    assert leader.propose("v", 1)
    assert leader.persistent.log.last_index == before


def test_a_value_of_another_type_is_another_value(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    leader.propose("v", 1)
    leader.propose("v", True)
    network.run(0.2)
    assert leader.persistent.log.values["v"] is True


def test_the_log_does_not_grow(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    for number in range(200):
        leader.propose("v", number)
        network.run(0.1)
    assert max(len(node.persistent.log.entries) for node in network.nodes.values()) <= 1


@pytest.mark.parametrize("majority", [True, False])
def test_in_classic_mode_only_a_majority_goes_on(network_type, majority):
    network = network_type(5, 1)
    leader = network.elect()
    others = [node_id for node_id in network.nodes if node_id != leader.node_id]
    network.partition([leader.node_id, *others[: 2 if majority else 1]])
    network.run(2.0)
    assert leader.propose("v", 42) is majority
    network.run(0.3)
    assert (leader.persistent.log.values == {"v": 42}) is majority


def test_in_classic_mode_a_leader_without_a_majority_resigns(network_type):
    network = network_type(5, 1)
    leader = network.elect()
    network.partition([leader.node_id])
    network.run(1.0)
    assert (leader.state, leader.leader_id) == (RaftState.FOLLOWER, None)


@pytest.mark.parametrize("seed", range(10))
def test_in_fault_tolerant_mode_both_sides_go_on_in_terms_of_their_own(network_type, seed):
    network = network_type(9, seed, RaftMode.FAULT_TOLERANT)
    network.elect()
    network.partition(range(4))
    network.run(4.0)
    leaders = network.leaders
    assert {node.node_id < 4 for node in leaders} == {True, False}
    assert len({node.persistent.current_term for node in leaders}) == len(leaders) == 2
    for node in leaders:
        assert node.propose("v", node.node_id)
    network.run(0.5)
    assert all(node.persistent.log.values == {"v": node.node_id} for node in leaders)
    network.check_recovery()


@BOTH_MODES
def test_a_leader_that_always_proposes_notices_that_nobody_answers(network_type, mode):
    network = network_type(3, 1, mode)
    leader = network.elect()
    network.partition([leader.node_id])
    for number in range(200):
        leader.propose("v", number)
        network.run(0.01)
    assert leader.state is RaftState.FOLLOWER


def test_committing_needs_the_majority_of_members_set_later(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    leader.set_known_nodes(range(100))
    leader.propose("v", 42)
    network.run(0.04)  # all have answered; another node, which counts three members, may commit it later
    assert leader.persistent.log.values == {}


# ---- durations of timers ----


@pytest.mark.parametrize(
    ("timer", "low_s", "high_s"),
    [
        ("election_timeout", 0.15, 0.3),
        ("heartbeat", 0.045, 0.055),
        ("discovery_timeout", 0.03, 0.0367),
        ("reply", 0.0, 0.005),
    ],
)
def test_durations_are_drawn_from_all_of_their_range(timer, low_s, high_s):
    provider = BareProvider()
    durations_s = []
    provider.schedule_timer = lambda name, time_s: (
        durations_s.append(time_s - 7.0) if name == f"__RAFT__:{timer}" else None
    )
    node = RaftNode(RaftConfig().set_logging(False), provider)
    node.start()
    for _ in range(300):
        node.handle_timer("election_timeout")  # the election and discovery timers
        node.handle_message(DiscoveryHeartbeatResponse(0, 1).to_json())
        for _ in range(6):
            node.handle_timer("discovery_timeout")
        node.handle_message(RequestVote(0, 1).to_json())  # the reply timer
    tenth_s = (high_s - low_s) / 10
    assert low_s <= min(durations_s) < low_s + tenth_s
    assert high_s - tenth_s < max(durations_s) <= high_s
