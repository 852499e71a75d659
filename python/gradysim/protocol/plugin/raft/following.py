"""A follower: it takes what its leader sends."""

import logging

from gradysim.protocol.plugin.raft.activity import SharedView
from gradysim.protocol.plugin.raft.raft_core import RaftCore
from gradysim.protocol.plugin.raft.raft_message import AppendEntries, AppendEntriesResponse
from gradysim.protocol.plugin.raft.raft_state import RaftState


class Following:
    """Takes the log of the leader for its own."""

    def __init__(self, core: RaftCore) -> None:
        """Take part in the node's state."""
        self._core = core

    def handle_entries(self, message: AppendEntries) -> None:
        """A leader has sent its log: follow it, unless its term is over."""
        core = self._core
        persistent = core.persistent
        leader = message.leader_id
        if message.term < persistent.current_term or (
            message.term == persistent.current_term and core.state is RaftState.LEADER
        ):
            core.outbox.reply(AppendEntriesResponse(persistent.current_term, False, core.node_id, 0), leader)
            return
        core.adopt_term(message.term)
        if core.leader_id != leader:
            core.log(logging.INFO, "following node %s in term %s", leader, message.term)
        core.become_follower()
        core.leader_id = leader
        core.leader_heard_s = core.environment.now_s()
        core.timers.restart_election()
        if message.active_nodes_count is not None:
            nodes = message.active_nodes_list
            core.activity.shared = SharedView(
                message.active_nodes_count,
                None if nodes is None else frozenset(nodes),
                core.leader_heard_s,
            )
        log, theirs = persistent.log, message.log()
        accepted = True
        if log.contradicts(theirs):
            accepted = core.config.is_fault_tolerant_mode()
            core.log(
                logging.WARNING,
                "what was committed here up to entry %s is not in the log of leader %s: %s",
                log.base_index,
                leader,
                "giving it up" if accepted else "keeping it. Do all nodes know the same members?",
            )
        if accepted:
            log.follow(theirs)
        matched = theirs.last_index if accepted else 0
        core.outbox.reply(
            AppendEntriesResponse(persistent.current_term, accepted, core.node_id, matched), leader
        )
