"""A network of Raft nodes with random faults, drawn from a seed, and the rules that must hold."""

import copy
import heapq
import itertools
import json
import math
from dataclasses import dataclass
from random import Random

import pytest

from gradysim.protocol.plugin.raft import RaftConfig, RaftMode, RaftState
from gradysim.protocol.plugin.raft.raft_node import RaftNode
from gradysim.protocol.plugin.raft.raft_state import PersistentState
from gradysim.protocol.plugin.raft.transport import PREFIX


@dataclass
class Faults:
    """Faults of messages. A message with a long delay is mostly outdated when it arrives."""

    loss: float = 0.0
    duplication: float = 0.0
    delay_s: tuple[float, float] = (0.001, 0.02)
    long_delay: float = 0.0
    long_delay_s: tuple[float, float] = (0.1, 0.8)


class Rules:
    """Checks the guarantees of the Raft paper after every event.

    These are Election Safety, Log Matching, Leader Completeness and State Machine Safety. The last two, and
    that a node keeps what it committed, are not guaranteed without a common majority. `partial` omits them.
    """

    def __init__(self, partial=False):
        self._partial = partial
        self.leaders = {}
        self._entries = {}
        self._committed = {0: 0}
        self._states = {0: "{}"}
        self._bases = {}

    @property
    def committed_count(self):
        return len(self._committed) - 1

    def check(self, node):
        log = node.persistent.log
        self._check_log_matching(log)
        if not self._partial:
            self._check_committed(node.node_id, log)
        if node.state is RaftState.LEADER:
            self._check_leader(node)

    def _check_log_matching(self, log):
        for index, entry in enumerate(log.entries, start=log.base_index + 1):
            content = (entry.name, json.dumps(entry.value), log.term_at(index - 1))
            assert self._entries.setdefault((index, entry.term), content) == content, "log matching"
        assert log.base_index == 0 or (log.base_index, log.base_term) in self._entries

    def _check_committed(self, node_id, log):
        base = self._bases.get(node_id, (0, 0))
        if base == (log.base_index, log.base_term):
            return
        assert log.base_index > base[0], "a node lost a committed entry"
        self._bases[node_id] = (log.base_index, log.base_term)
        chain = []
        index, term = log.base_index, log.base_term
        while index not in self._committed:
            chain.append((index, term))
            index, term = index - 1, self._entries[index, term][2]
        assert self._committed[index] == term, "state machine safety"
        for index, term in reversed(chain):
            name, value, _ = self._entries[index, term]
            state = json.loads(self._states[index - 1])
            if name is not None:
                state[name] = json.loads(value)
            self._committed[index] = term
            self._states[index] = json.dumps(state, sort_keys=True)
        assert self._states[log.base_index] == json.dumps(log.values, sort_keys=True), "state machine safety"

    def _check_leader(self, node):
        term = node.persistent.current_term
        if term in self.leaders:
            assert self.leaders[term] == node.node_id, "two leaders in one term"
            return
        self.leaders[term] = node.node_id
        if not self._partial:
            log = node.persistent.log
            for index, committed_term in self._committed.items():
                assert index < log.base_index or log.term_at(index) == committed_term, "leader completeness"


class NetworkProvider:
    """Provider of one life of a node, from its start to its crash."""

    def __init__(self, network, node_id):
        self._network = network
        self._node_id = node_id
        self.random = network.random
        self._timers = {}

    @property
    def _is_alive(self):
        return self._network.providers.get(self._node_id) is self

    def get_id(self):
        return self._node_id

    def current_time(self):
        return self._network.now_s

    def send_communication_command(self, command):
        if self._is_alive:
            text = command.message.removeprefix(PREFIX)
            self._network.transmit(self._node_id, text, command.destination)

    def schedule_timer(self, timer, timestamp):
        name = timer.removeprefix(PREFIX)
        generation = self._timers.setdefault(name, 0)

        def fire():
            if self._is_alive and self._timers[name] == generation:
                node = self._network.nodes[self._node_id]
                node.handle_timer(name)
                self._network.rules.check(node)

        self._network.schedule(timestamp, fire)

    def cancel_timer(self, timer):
        name = timer.removeprefix(PREFIX)
        self._timers[name] = self._timers.get(name, 0) + 1


class Network:
    """Nodes 0 to count-1 and an event loop. A crash keeps the `PersistentState` and loses everything else."""

    def __init__(self, count, seed, mode=RaftMode.CLASSIC, faults=None, known=True, partial=None):
        self.random = Random(seed)
        self.now_s = 0.0
        self.faults = faults or Faults()
        self.config = RaftConfig().add_consensus_variable("v", int).add_consensus_variable("w", str)
        self.config.set_raft_mode(mode).set_logging(False)
        self.rules = Rules(mode is RaftMode.FAULT_TOLERANT if partial is None else partial)
        self.count = count
        self.known = known
        self.nodes = {}
        self.providers = {}
        self.disks = {node_id: PersistentState() for node_id in range(count)}
        self.group = dict.fromkeys(range(count), 0)
        self.sent = 0
        self._events = []
        self._serial = itertools.count()
        for node_id in range(count):
            self.restart(node_id)

    def schedule(self, time_s, action):
        heapq.heappush(self._events, (time_s, next(self._serial), action))

    def run(self, duration_s, until=None):
        """Run for a time, or until a condition holds. Return whether it does."""
        end_s = self.now_s + duration_s
        while self._events and self._events[0][0] <= end_s:
            self.now_s, _, action = heapq.heappop(self._events)
            action()
            if until is not None and until():
                return True
        self.now_s = end_s
        return until is not None and until()

    def transmit(self, source, message, destination):
        self.sent += 1
        faults, chance = self.faults, self.random.random
        for target in range(self.count) if destination is None else (destination,):
            if target == source or self.group[target] != self.group[source] or chance() < faults.loss:
                continue
            for _ in range(1 + (chance() < faults.duplication)):
                delay_s = faults.long_delay_s if chance() < faults.long_delay else faults.delay_s
                self.schedule(
                    self.now_s + self.random.uniform(*delay_s),
                    lambda target=target: self._deliver(target, source, message),
                )

    def _deliver(self, target, source, message):
        if target in self.nodes and self.group[target] == self.group[source]:
            self.nodes[target].handle_message(message)
            self.rules.check(self.nodes[target])

    def crash(self, node_id):
        if node_id in self.nodes:
            self.disks[node_id] = copy.deepcopy(self.nodes.pop(node_id).persistent)
            del self.providers[node_id]

    def restart(self, node_id):
        if node_id in self.nodes:
            return
        self.providers[node_id] = NetworkProvider(self, node_id)
        node = RaftNode(self.config, self.providers[node_id], copy.deepcopy(self.disks[node_id]))
        self.nodes[node_id] = node
        if self.known:
            node.set_known_nodes(range(self.count))
        node.start()

    def partition(self, *groups):
        """Split the network into groups. Nodes that are not named form one more group."""
        self.group = dict.fromkeys(range(self.count), len(groups))
        for number, group in enumerate(groups):
            self.group.update(dict.fromkeys(group, number))

    def heal(self):
        """Remove all faults."""
        self.group = dict.fromkeys(range(self.count), 0)
        self.faults = Faults()
        for node_id in range(self.count):
            self.restart(node_id)
            self.nodes[node_id].set_active(True)

    @property
    def leaders(self):
        return [node for node in self.nodes.values() if node.state is RaftState.LEADER]

    @property
    def leader(self):
        """The leader that all nodes follow, if there is one."""
        leaders = self.leaders
        if len(leaders) == 1 and all(node.leader_id == leaders[0].node_id for node in self.nodes.values()):
            return leaders[0]
        return None

    def elect(self, within_s=5.0):
        assert self.run(within_s, until=lambda: self.leader is not None), "no leader"
        return self.leader

    def propose(self, name, value):
        """Propose at one of the leaders. Return whether there was one that accepted."""
        leaders = self.leaders
        if not leaders:
            return False
        node = self.random.choice(leaders)
        taken = node.propose(name, value)
        self.rules.check(node)
        return taken

    def agree_on(self, name, value):
        """Whether all nodes have committed that value."""
        return len(self.nodes) == self.count and all(
            node.persistent.log.values.get(name) == value for node in self.nodes.values()
        )

    def inject_random_faults(self, duration_s):
        """Change the faults at random, about every 80 ms."""
        draw = self.random
        end_s = self.now_s + duration_s
        value = itertools.count(1)
        while self.now_s < end_s:
            all_nodes = range(self.count)
            match draw.randrange(9):
                case 0:
                    self.partition(draw.sample(all_nodes, draw.randint(1, self.count - 1)))
                case 1:
                    half = draw.randint(1, math.ceil(self.count / 3))
                    mixed = draw.sample(all_nodes, self.count)
                    self.partition(mixed[:half], mixed[half : 2 * half])
                case 2:
                    self.partition()
                case 3:
                    leaders = [node.node_id for node in self.leaders] or list(all_nodes)
                    self.crash(draw.choice([draw.choice(leaders), draw.randrange(self.count)]))
                case 4 | 5:
                    self.restart(draw.randrange(self.count))
                    self.nodes.get(draw.randrange(self.count), next(iter(self.nodes.values()))).set_active(
                        True
                    )
                case 6:
                    self.faults = Faults(
                        loss=draw.choice([0.0, 0.1, 0.3, 0.6]),
                        duplication=draw.choice([0.0, 0.2]),
                        delay_s=draw.choice([(0.0, 0.0), (0.001, 0.01), (0.0, 0.08)]),
                        long_delay=draw.choice([0.0, 0.05, 0.4]),
                    )
                case 7:
                    for node in self.leaders:
                        node.set_active(draw.random() < 0.5)
                case 8:
                    pass
            for _ in range(draw.randint(0, 3)):
                self.propose(draw.choice("vw"), next(value))
            self.run(draw.uniform(0.0, 0.16))

    def check_recovery(self):
        """Liveness: without faults there is a leader, and its proposals arrive everywhere."""
        self.heal()
        self.run(1.0)  # a running election may still depose a leader
        leader = self.elect(within_s=6.0)
        assert leader.propose("v", -1)
        assert self.run(4.0, until=lambda: self.agree_on("v", -1)), "a value does not arrive everywhere"
        self.run(0.5)
        bases = {
            (node.persistent.log.base_index, json.dumps(node.persistent.log.values, sort_keys=True))
            for node in self.nodes.values()
        }
        assert len(bases) == 1, "followers do not catch up"


@pytest.fixture(scope="session")
def network_type():
    return Network


@pytest.fixture(scope="session")
def faults_type():
    return Faults
