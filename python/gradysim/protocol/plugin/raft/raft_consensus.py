"""The consensus plugin: a protocol agrees with other nodes on the values of variables."""

import logging
from collections.abc import Iterable, Mapping
from typing import Any

from gradysim.protocol.interface import IProtocol, IProvider
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.plugin.raft.raft_config import RaftConfig
from gradysim.protocol.plugin.raft.raft_node import RaftNode
from gradysim.protocol.plugin.raft.raft_state import RaftState, json_value, majority_of, typed_value
from gradysim.protocol.plugin.raft.transport import PREFIX, RAFT_DISPATCH_PREFIX

__all__ = ["RAFT_DISPATCH_PREFIX", "RaftConsensusPlugin"]

_REQUIRED_METHODS = sorted(IProvider.__abstractmethods__ - {"send_mobility_command"})
_CLASSIC_SUMMARY = "Classic mode: every known node counts as active, failures are not detected"

_logger = logging.getLogger(__name__)


class RaftConsensusPlugin:
    """Raft consensus among the nodes whose protocols have this plugin.

    Create it in `initialize` or later, set the members with `set_known_nodes` and call `start`. The elected
    leader can propose values. All nodes see a value once it is committed. Messages and timers of the plugin
    do not reach the protocol::

        def initialize(self) -> None:
            config = RaftConfig().add_consensus_variable("target", int).set_raft_mode(RaftMode.CLASSIC)
            self.consensus = RaftConsensusPlugin(config, self)
            self.consensus.set_known_nodes(range(5))
            self.consensus.start()
    """

    def __init__(self, config: RaftConfig, protocol: IProtocol) -> None:
        """Attach the plugin to a `protocol` that has its provider. All nodes should have the same settings.

        Raise ValueError if the configuration is not valid, the protocol has no provider or one that lacks a
        method, or the node's id is not an integer >= 0.
        """
        if not isinstance(config, RaftConfig):
            raise ValueError(f"config must be a RaftConfig, got {config!r}")
        problems = config.validate()
        if problems:
            raise ValueError(f"invalid Raft configuration: {'; '.join(problems)}")
        provider = getattr(protocol, "provider", None)
        if provider is None:
            raise ValueError(
                f"{type(protocol).__name__} has no provider yet: create the plugin in initialize() or later"
            )
        missing = [name for name in _REQUIRED_METHODS if not callable(getattr(provider, name, None))]
        if missing:
            raise ValueError(f"the provider {type(provider).__name__} has no {', '.join(missing)}")
        if not _is_id(provider.get_id()):
            raise ValueError(f"a Raft node needs an integer id >= 0, got {provider.get_id()!r}")
        self._config = config
        self._node = RaftNode(config, provider)
        self._dispatcher = create_dispatcher(protocol)
        self._takes_messages = False
        self._takes_timers = False
        self.configure_handle_message()
        self.configure_handle_timer()

    # ---- taking part and agreeing --------------------------------------------------------------------------

    def start(self) -> None:
        """Start the node, or continue after `stop`. If it runs already, restart its election timeout."""
        self._node.start()

    def stop(self) -> None:
        """Stop the node. It keeps its term, vote and log. Do nothing if it is not running."""
        self._node.stop()

    def set_known_nodes(self, node_ids: Iterable[int]) -> None:
        """Set the members. The node itself is always a member. Messages from other nodes are then ignored.

        Use the same members on all nodes. Without this call, every node that this node hears of becomes a
        member. While values are proposed, add or remove one member at a time. Raise ValueError if an id is
        not an integer >= 0.
        """
        ids = list(node_ids)
        for node_id in ids:
            if not _is_id(node_id):
                raise ValueError(f"an id of a known node must be an integer >= 0, got {node_id!r}")
        self._node.set_known_nodes(ids)

    def propose_value(self, variable_name: str, value: Any) -> bool:
        """Propose a new value of a variable.

        Args:
            variable_name: A configured variable.
            value: Value of the variable's type. All nodes get the value as decoded from JSON: inside it,
                tuples become lists and keys of dicts become strings.

        Returns:
            True if this node is the leader and the value is in its log. Once a majority has the value, it is
            committed, and `get_committed_value` returns it. If the leader is deposed before that, the value
            may be lost. False if this node is not the leader; then nothing happens.

        Raises:
            ValueError: There is no such variable, the value is not of its type, or JSON cannot encode it.
        """
        var_type = self._type_of(variable_name)
        return self._node.propose(variable_name, json_value(variable_name, var_type, value))

    def get_committed_value(self, variable_name: str) -> Any | None:
        """Return the committed value of a variable as far as this node knows, or None.

        Raise ValueError if there is no such variable.
        """
        var_type = self._type_of(variable_name)
        return typed_value(var_type, self._node.persistent.log.values.get(variable_name))

    def get_all_committed_values(self) -> dict[str, Any]:
        """Return the committed value of each variable, None where there is none."""
        return self._values_by_variable(self._node.persistent.log.values)

    def send_broadcast(self, message: str) -> None:
        """Broadcast a string with the plugin's prefix. Other nodes ignore it unless it is a Raft message.

        Raise ValueError if it is not a string.
        """
        if not isinstance(message, str):
            raise ValueError(f"a message must be a str, got {message!r}")
        self._node.send_text(message)

    # ---- the node ------------------------------------------------------------------------------------------

    def get_node_id(self) -> int:
        """Return the node's id."""
        return self._node.node_id

    def is_leader(self) -> bool:
        """Whether this node is the leader."""
        return self._node.state is RaftState.LEADER

    def get_leader_id(self) -> int | None:
        """Return the id of the current leader, which may be this node, or None if it knows no leader."""
        return self._node.leader_id

    def get_current_term(self) -> int:
        """Return the term, 0 before the first election. Terms only increase, with gaps."""
        return self._node.persistent.current_term

    def get_current_state(self) -> RaftState:
        """Return the role of the node."""
        return self._node.state

    def is_ready(self) -> bool:
        """Whether the configuration is still valid, so that the node can take part."""
        return not self._config.validate()

    def get_state_info(self) -> dict[str, Any]:
        """Return the full state. `consensus_values` includes values that are not committed."""
        node, persistent = self._node, self._node.persistent
        return {
            "node_id": node.node_id,
            "state": str(node.state),
            "current_term": persistent.current_term,
            "voted_for": persistent.voted_for,
            "leader_id": node.leader_id,
            "consensus_values": self._values_by_variable(persistent.log.latest_values()),
            "committed_values": self.get_all_committed_values(),
            "commit_index": persistent.log.base_index,
            "last_log_index": persistent.log.last_index,
            "last_log_term": persistent.log.last_term,
            "known_nodes": sorted(node.membership.known),
            "active_timers": sorted(node.transport.pending_timers),
            "cluster_id": node.membership.cluster_id,
            "failure_detection": node.membership.detector.get_detection_summary(),
        }

    def get_statistics(self) -> dict[str, Any]:
        """Return the most important values of `get_state_info`."""
        values = self.get_all_committed_values().values()
        return {
            "node_id": self._node.node_id,
            "current_state": str(self._node.state),
            "current_term": self._node.persistent.current_term,
            "is_leader": self.is_leader(),
            "leader_id": self._node.leader_id,
            "consensus_variables": list(self._config.get_consensus_variables()),
            "committed_values_count": sum(value is not None for value in values),
            "active_timers_count": len(self._node.transport.pending_timers),
        }

    # ---- the configuration ---------------------------------------------------------------------------------

    def get_consensus_variables(self) -> dict[str, type]:
        """Return the type of each variable."""
        return self._config.get_consensus_variables()

    def has_consensus_variable(self, variable_name: str) -> bool:
        """Whether there is a variable of that name."""
        return self._config.has_consensus_variable(variable_name)

    def get_consensus_variable_type(self, variable_name: str) -> type | None:
        """Return the type of a variable, or None if there is no such variable."""
        return self._config.get_consensus_variable_type(variable_name)

    def get_configuration(self) -> dict[str, Any]:
        """Return all settings as `RaftConfig.to_dict` does."""
        return self._config.to_dict()

    # ---- active and failed nodes ---------------------------------------------------------------------------

    def get_simulation_active_nodes(self) -> set[int]:
        """Return the ids of the members without a simulated failure, as far as this node knows."""
        membership = self._node.membership
        return set(membership.known if self._node.is_active else membership.others)

    def get_communication_active_nodes(self) -> set[int]:
        """Return the ids of the members that answer, as far as this node knows; all in classic mode."""
        return set(self._node.active_nodes())

    def get_communication_failed_nodes(self) -> set[int]:
        """Return the ids of the members that do not answer; none in classic mode."""
        return set(self._node.membership.known - self._node.active_nodes())

    get_failed_nodes = get_communication_failed_nodes

    def get_active_nodes(self) -> set[int]:
        """Return the ids of the members that answer and have no simulated failure."""
        return self.get_simulation_active_nodes() & self.get_communication_active_nodes()

    def get_active_nodes_info(self) -> dict[str, Any]:
        """Return which nodes are active and failed, and how that is known (`detection_method`).

        `last_update` is the time (s) of the information, 0 if there is none.
        """
        node = self._node
        active = self.get_active_nodes()
        failed = self.get_simulation_active_nodes() - active
        method, last_update_s = self._detection()
        count = len(active)
        view = node.membership.leader_view
        if method == "leader_shared_count_only" and view is not None:
            count = view.count
        return {
            "active_nodes": sorted(active),
            "active_count": count,
            "failed_nodes": sorted(failed),
            "failed_count": len(failed),
            "total_known": len(node.membership.known),
            "majority_threshold": majority_of(count),
            "has_majority": self.has_quorum(),
            "detection_method": method,
            "detection_summary": _CLASSIC_SUMMARY
            if self._config.is_classic_mode()
            else node.membership.detector.get_detection_summary(),
            "last_update": last_update_s,
            "is_leader": self.is_leader(),
            "leader_id": node.leader_id,
            "current_node_id": node.node_id,
            "current_term": node.persistent.current_term,
            "node_role": node.state.name.lower(),
            "raft_mode": self._config.get_raft_mode().value,
        }

    def has_quorum(self) -> bool:
        """Whether at least two members are active, or the members were set to this node alone."""
        single = self._node.membership.is_single_node and self._node.is_active
        return single or len(self.get_active_nodes()) >= 2

    def has_majority_votes(self) -> bool:
        """Whether this node won the election of the current term and still leads."""
        return self.is_leader()

    def has_majority_confirmation(self) -> bool:
        """Whether this node is the leader and a majority has its whole log."""
        node = self._node
        if node.leadership is None:
            return False
        confirming = node.leadership.confirming(node.persistent.log.last_index)
        return node.has_majority({*confirming, node.node_id}, node.electorate())

    def get_majority_info(self) -> dict[str, Any]:
        """Return how many nodes make a majority, and how many voted for this node and have its log."""
        node = self._node
        active = self.get_active_nodes()
        votes, confirmed = 0, 0
        if node.election is not None:
            votes = len(node.election.votes)
        elif node.leadership is not None:
            votes = node.leadership.votes
            confirmed = len(node.leadership.confirming(node.persistent.log.last_index))
        view = node.membership.leader_view
        return {
            "active_nodes": sorted(active),
            "total_active": len(active),
            "majority_threshold": majority_of(len(active)),
            "has_majority": self.has_quorum(),
            "votes_received": votes,
            "confirmed_nodes": confirmed,
            "known_active_info": {
                "known_active_count": None if view is None else view.count,
                "is_fresh": node.membership.fresh_leader_view(node.lease_start_s()) is not None,
                "last_update": 0.0 if view is None else view.time_s,
            },
        }

    def is_node_failed(self, node_id: int) -> bool:
        """Whether a member does not answer. False for a node that is not a member."""
        return node_id in self.get_failed_nodes()

    is_communication_failed = is_node_failed

    def is_simulation_active(self, node_id: int) -> bool:
        """Whether a node has no simulated failure. Other nodes count as active, since it is not known."""
        return self._node.is_active if node_id == self._node.node_id else True

    get_is_active = is_simulation_active

    def set_simulation_active(self, node_id: int, active: bool) -> None:
        """Simulate a failure of this node (False), or its recovery (True).

        A failed node sends and receives nothing. It keeps its term, vote and log, but a leader first gives
        up its term. With the id of another node, this only logs a warning: use that node's plugin. Raise
        ValueError if `active` is not a bool.
        """
        if not isinstance(active, bool):
            raise ValueError(f"active must be True or False, got {active!r}")
        if node_id != self._node.node_id:
            _logger.warning(
                "node %s cannot make node %r active or inactive: call it on that node's own plugin",
                self._node.node_id,
                node_id,
            )
            return
        self._node.set_active(active)

    set_is_active = set_simulation_active

    def get_failure_detection_metrics(self) -> dict[str, Any]:
        """Return counters and times of the failure detection."""
        return self._node.membership.detector.get_detection_metrics()

    # ---- clusters ------------------------------------------------------------------------------------------

    def set_cluster_id(self, cluster_id: int | None) -> None:
        """Set the cluster. The node then ignores other clusters. Nodes with None form a cluster, too.

        Raise ValueError if it is not None or an integer >= 0.
        """
        if cluster_id is not None and not _is_id(cluster_id):
            raise ValueError(f"a cluster id must be an integer >= 0 or None, got {cluster_id!r}")
        self._node.membership.cluster_id = cluster_id

    def get_cluster_id(self) -> int | None:
        """Return the cluster of this node."""
        return self._node.membership.cluster_id

    def is_in_same_cluster(self, other_node_id: int) -> bool:
        """Whether a node is in this cluster by its latest message, or is a member if it sent none."""
        return self._node.membership.shares_cluster_with(other_node_id)

    # ---- messages and timers -------------------------------------------------------------------------------

    def configure_handle_message(self) -> None:
        """Handle Raft messages before the protocol gets them. The constructor calls this."""
        if not self._takes_messages:
            self._takes_messages = True
            self._dispatcher.register_handle_packet(self._handle_packet)

    def configure_handle_timer(self) -> None:
        """Handle Raft timers before the protocol gets them. The constructor calls this."""
        if not self._takes_timers:
            self._takes_timers = True
            self._dispatcher.register_handle_timer(self._handle_timer)

    def handle_message(self, message: str) -> bool:
        """Handle a message if it belongs to the plugin. Return whether it does."""
        if not message.startswith(PREFIX):
            return False
        self._node.handle_message(message.removeprefix(PREFIX))
        return True

    def handle_timer(self, timer: str) -> bool:
        """Handle a timer if it belongs to the plugin. Return whether it does."""
        if not timer.startswith(PREFIX):
            return False
        self._node.handle_timer(timer.removeprefix(PREFIX))
        return True

    def _handle_packet(self, _protocol: IProtocol, message: str) -> DispatchReturn:
        return DispatchReturn.INTERRUPT if self.handle_message(message) else DispatchReturn.CONTINUE

    def _handle_timer(self, _protocol: IProtocol, timer: str) -> DispatchReturn:
        return DispatchReturn.INTERRUPT if self.handle_timer(timer) else DispatchReturn.CONTINUE

    def _type_of(self, variable_name: str) -> type:
        var_type = self._config.get_consensus_variable_type(variable_name)
        if var_type is None:
            names = ", ".join(self._config.get_consensus_variables())
            raise ValueError(f"there is no consensus variable {variable_name!r}, only {names}")
        return var_type

    def _values_by_variable(self, values: Mapping[str, Any]) -> dict[str, Any]:
        variables = self._config.get_consensus_variables()
        return {name: typed_value(var_type, values.get(name)) for name, var_type in variables.items()}

    def _detection(self) -> tuple[str, float]:
        """Return how the active nodes are known, and the time (s) of that information."""
        node, membership = self._node, self._node.membership
        reported_s = 0.0 if membership.leader_view is None else membership.leader_view.time_s
        if self._config.is_classic_mode():
            return "classic_mode_all_active", node.transport.now_s() if self.is_leader() else reported_s
        if self.is_leader():
            return "leader_heartbeat_detection", node.transport.now_s()
        view = membership.fresh_leader_view(node.lease_start_s())
        if view is None:
            return "follower_local_detection", reported_s
        return (
            "leader_shared_count_only" if view.nodes is None else "leader_shared_complete_list"
        ), reported_s


def _is_id(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0
