"""The plugin: gives a protocol a share in variables that all nodes agree on."""

import logging
from collections.abc import Iterable
from typing import Any

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher
from gradysim.protocol.plugin.raft import node_report
from gradysim.protocol.plugin.raft.provider_environment import (
    PREFIX,
    RAFT_DISPATCH_PREFIX,
    REQUIRED_METHODS,
    ProviderEnvironment,
)
from gradysim.protocol.plugin.raft.raft_config import RaftConfig
from gradysim.protocol.plugin.raft.raft_node import RaftNode
from gradysim.protocol.plugin.raft.raft_state import RaftState
from gradysim.protocol.plugin.raft.value import carried_value, typed_value

__all__ = ["RAFT_DISPATCH_PREFIX", "RaftConsensusPlugin"]

_logger = logging.getLogger(__name__)


class RaftConsensusPlugin:
    """Consensus by Raft among the nodes whose protocols have this plugin.

    Create it in `initialize` or later, tell it the members with `set_known_nodes` and call `start`. Whoever
    is the leader then can propose values; once committed they are seen on all nodes. Messages and timers of
    the plugin do not reach the protocol.

    ```python
    def initialize(self) -> None:
        config = RaftConfig().add_consensus_variable("target", int).set_raft_mode(RaftMode.CLASSIC)
        self.consensus = RaftConsensusPlugin(config, self)
        self.consensus.set_known_nodes(range(5))
        self.consensus.start()
    ```
    """

    def __init__(self, config: RaftConfig, protocol: IProtocol) -> None:
        """Attach to `protocol`.

        Args:
            config: Settings; all nodes should have the same.
            protocol: It has its provider already.

        Raises:
            ValueError: The configuration is not valid, the protocol has no provider or one that lacks a
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
        missing = [name for name in REQUIRED_METHODS if not callable(getattr(provider, name, None))]
        if missing:
            raise ValueError(f"the provider {type(provider).__name__} has no {', '.join(missing)}")
        environment = ProviderEnvironment(provider)
        if not _is_id(environment.node_id):
            raise ValueError(f"a Raft node needs an integer id >= 0, got {environment.node_id!r}")
        self._config = config
        self._node = RaftNode(config, environment)
        self._dispatcher = create_dispatcher(protocol)
        self._takes_messages = False
        self._takes_timers = False
        self.configure_handle_message()
        self.configure_handle_timer()

    # ---- taking part ---------------------------------------------------------------------------------------

    def start(self) -> None:
        """Begin to take part, or go on after `stop`. Called twice, only the election timeout begins anew."""
        self._node.start()

    def stop(self) -> None:
        """Take no part any more. What is known stays; no-op if it was stopped already."""
        self._node.stop()

    def set_known_nodes(self, node_ids: Iterable[int]) -> None:
        """Set who is a member; the node itself always is. Messages of others are ignored from then on.

        All nodes should be told the same. Without this call a node takes every node that it hears of for a
        member. Changing the members while values are being agreed on is safe one node at a time.

        Raises:
            ValueError: An id is not an integer >= 0.
        """
        ids = list(node_ids)
        for node_id in ids:
            if not _is_id(node_id):
                raise ValueError(f"an id of a known node must be an integer >= 0, got {node_id!r}")
        self._node.set_known_nodes(ids)

    def propose_value(self, variable_name: str, value: Any) -> bool:
        """Have all nodes agree on a new value.

        Args:
            variable_name: A configured variable.
            value: Of its type. All nodes get what comes out of JSON: inside of it, tuples become lists,
                and keys of dicts become texts.

        Returns:
            False if this node is not the leader: then nothing happens. True if the value is in the leader's
            log; it is committed, and seen by `get_committed_value`, as soon as the majority has it. A leader
            that loses its office before that may lose the value, too.

        Raises:
            ValueError: There is no such variable, the value is not of its type, or JSON cannot carry it.
        """
        kind = self._type_of(variable_name)
        return self._node.propose(variable_name, carried_value(variable_name, kind, value))

    def get_committed_value(self, variable_name: str) -> Any | None:
        """Return what is agreed on, as far as this node knows; None if nothing yet.

        Raises:
            ValueError: There is no such variable.
        """
        kind = self._type_of(variable_name)
        return typed_value(kind, self._node.persistent.log.values.get(variable_name))

    def get_all_committed_values(self) -> dict[str, Any]:
        """Return the same for all variables."""
        return node_report.committed_values(self._node)

    def send_broadcast(self, message: str) -> None:
        """Broadcast a text behind the plugin's prefix. Nodes ignore it unless it is a message of the
        consensus.

        Raises:
            ValueError: It is not a text.
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
        """Return the id of the leader that this node follows, or its own; None if it knows of none."""
        return self._node.leader_id

    def get_current_term(self) -> int:
        """Return the term, 0 before the first election. Terms only grow; there are gaps between them."""
        return self._node.persistent.current_term

    def get_current_state(self) -> RaftState:
        """Return what the node is doing."""
        return self._node.state

    def is_ready(self) -> bool:
        """Whether the configuration is (still) valid, so that the node can take part."""
        return not self._config.validate()

    def get_state_info(self) -> dict[str, Any]:
        """Return everything about the node as plain data."""
        return node_report.state_info(self._node)

    def get_statistics(self) -> dict[str, Any]:
        """Return the most important of it."""
        return node_report.statistics(self._node)

    # ---- the configuration ---------------------------------------------------------------------------------

    def get_consensus_variables(self) -> dict[str, type]:
        """Return the type of each variable."""
        return self._config.get_consensus_variables()

    def has_consensus_variable(self, variable_name: str) -> bool:
        """Whether there is a variable of that name."""
        return self._config.has_consensus_variable(variable_name)

    def get_consensus_variable_type(self, variable_name: str) -> type | None:
        """Return the type of a variable; None if there is none of that name."""
        return self._config.get_consensus_variable_type(variable_name)

    def get_configuration(self) -> dict[str, Any]:
        """Return all settings as plain data."""
        return self._config.to_dict()

    # ---- who is there --------------------------------------------------------------------------------------

    def get_simulation_active_nodes(self) -> set[int]:
        """Ids of the members that do not play dead, as far as this node knows."""
        return node_report.simulation_active_nodes(self._node)

    def get_communication_active_nodes(self) -> set[int]:
        """Ids of the members that answer, as far as this node knows; all of them in classic mode."""
        return node_report.communication_active_nodes(self._node)

    def get_communication_failed_nodes(self) -> set[int]:
        """Ids of the members that do not answer, as far as this node knows; none in classic mode."""
        return node_report.communication_failed_nodes(self._node)

    def get_failed_nodes(self) -> set[int]:
        """The same as `get_communication_failed_nodes`."""
        return self.get_communication_failed_nodes()

    def get_active_nodes(self) -> set[int]:
        """Ids of the members that answer and do not play dead, as far as this node knows."""
        return node_report.active_nodes(self._node)

    def get_active_nodes_info(self) -> dict[str, Any]:
        """Return which nodes are active, and how that is known: see `detection_method`."""
        return node_report.active_nodes_info(self._node)

    def has_quorum(self) -> bool:
        """Whether at least two members are active (or the node was set to be alone)."""
        return node_report.has_quorum(self._node)

    def has_majority_votes(self) -> bool:
        """Whether this node won the election of the present term."""
        return node_report.has_majority_votes(self._node)

    def has_majority_confirmation(self) -> bool:
        """Whether this node is the leader and the majority has all that was proposed."""
        return node_report.has_majority_confirmation(self._node)

    def get_majority_info(self) -> dict[str, Any]:
        """Return how many nodes make a majority, and how many voted for and follow this node."""
        return node_report.majority_info(self._node)

    def is_node_failed(self, node_id: int) -> bool:
        """Whether a member does not answer; False for a stranger."""
        return node_id in self.get_failed_nodes()

    def is_communication_failed(self, node_id: int) -> bool:
        """The same as `is_node_failed`."""
        return self.is_node_failed(node_id)

    def is_simulation_active(self, node_id: int) -> bool:
        """Whether a node does not play dead; of others nobody knows, they count as active."""
        return self._node.is_active if node_id == self._node.node_id else True

    def get_is_active(self, node_id: int) -> bool:
        """The same as `is_simulation_active`."""
        return self.is_simulation_active(node_id)

    def set_simulation_active(self, node_id: int, active: bool) -> None:
        """Have this node play dead, or rise again.

        While it plays dead it sends nothing and hears nothing; a leader gives up its term first. What it
        knows stays.

        Args:
            node_id: This node's own id. Another one does nothing but warn in the log: each node plays dead
                by itself.
            active: False to play dead.

        Raises:
            ValueError: `active` is not a bool.
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

    def set_is_active(self, node_id: int, active: bool) -> None:
        """The same as `set_simulation_active`."""
        self.set_simulation_active(node_id, active)

    def get_failure_detection_metrics(self) -> dict[str, Any]:
        """Return counters and times of the failure detection as plain data."""
        return self._node.activity.detector.get_detection_metrics()

    # ---- clusters ------------------------------------------------------------------------------------------

    def set_cluster_id(self, cluster_id: int | None) -> None:
        """Put the node into a cluster: from now on it hears only nodes of the same one. None is one, too.

        Raises:
            ValueError: It is not None or an integer >= 0.
        """
        if cluster_id is not None and not _is_id(cluster_id):
            raise ValueError(f"a cluster id must be an integer >= 0 or None, got {cluster_id!r}")
        self._node.cluster.cluster_id = cluster_id

    def get_cluster_id(self) -> int | None:
        """Return the cluster that the node was put into."""
        return self._node.cluster.cluster_id

    def is_in_same_cluster(self, other_node_id: int) -> bool:
        """Whether a node is in this one's cluster, by its last message; a silent one is if it is a member."""
        return node_report.shares_cluster_with(self._node, other_node_id)

    # ---- messages and timers -------------------------------------------------------------------------------

    def configure_handle_message(self) -> None:
        """Take the consensus's messages out of those that the protocol gets. The constructor has done it."""
        if not self._takes_messages:
            self._takes_messages = True
            self._dispatcher.register_handle_packet(self._handle_packet)

    def configure_handle_timer(self) -> None:
        """Take the consensus's timers out of those that the protocol gets. The constructor has done it."""
        if not self._takes_timers:
            self._takes_timers = True
            self._dispatcher.register_handle_timer(self._handle_timer)

    def handle_message(self, message: str) -> bool:
        """Hand over a message by hand; whether it was one of the consensus."""
        if not message.startswith(PREFIX):
            return False
        self._node.handle_message(message.removeprefix(PREFIX))
        return True

    def handle_timer(self, timer: str) -> bool:
        """Hand over a timer by hand; whether it was one of the consensus."""
        if not timer.startswith(PREFIX):
            return False
        self._node.handle_timer(timer.removeprefix(PREFIX))
        return True

    def _handle_packet(self, _protocol: IProtocol, message: str) -> DispatchReturn:
        return DispatchReturn.INTERRUPT if self.handle_message(message) else DispatchReturn.CONTINUE

    def _handle_timer(self, _protocol: IProtocol, timer: str) -> DispatchReturn:
        return DispatchReturn.INTERRUPT if self.handle_timer(timer) else DispatchReturn.CONTINUE

    def _type_of(self, variable_name: str) -> type:
        kind = self._config.get_consensus_variable_type(variable_name)
        if kind is None:
            names = ", ".join(self._config.get_consensus_variables())
            raise ValueError(f"there is no consensus variable {variable_name!r}, only {names}")
        return kind


def _is_id(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0
