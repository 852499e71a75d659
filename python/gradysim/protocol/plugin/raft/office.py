"""A leader: it takes proposals, tells everybody, commits, and resigns when it has lost its majority."""

import logging
from typing import Any

from gradysim.protocol.plugin.raft.election import Election
from gradysim.protocol.plugin.raft.leadership import Leadership
from gradysim.protocol.plugin.raft.node_timers import ELECTION_TIMER
from gradysim.protocol.plugin.raft.raft_core import RaftCore
from gradysim.protocol.plugin.raft.raft_log import Entry
from gradysim.protocol.plugin.raft.raft_message import AppendEntries, AppendEntriesResponse
from gradysim.protocol.plugin.raft.raft_state import RaftState
from gradysim.protocol.plugin.raft.value import same_value


class Office:
    """What a node does as the leader; while it is none, nothing."""

    def __init__(self, core: RaftCore) -> None:
        """Take part in the node's state."""
        self._core = core

    def begin(self, election: Election) -> None:
        """Lead: the election is won."""
        core = self._core
        term, log = core.persistent.current_term, core.persistent.log
        core.election = None
        core.state = RaftState.LEADER
        core.leader_id = core.node_id
        core.leadership = Leadership(core.node_id, term, core.now_s(), election.votes)
        core.activity.begin_to_lead(election.seen)
        core.timers.cancel(ELECTION_TIMER)
        core.log(logging.INFO, "leader of term %s with %s votes", term, len(election.votes))
        # Entries of earlier terms are committed with one of this term (Raft, section 8).
        log.append(Entry(term, None, None))
        self.commit_what_can_be()
        self._send_entries()
        core.timers.restart_heartbeat()

    def propose(self, name: str, value: Any) -> bool:
        """Add an entry to the log; False unless this node leads. A value that holds already needs none."""
        core = self._core
        if core.leadership is None:
            return False
        log = core.persistent.log
        if same_value(log.latest_values().get(name), value):
            return True
        log.append(Entry(core.persistent.current_term, name, value))
        self.commit_what_can_be()
        self._send_entries()
        return True

    def handle_heartbeat(self) -> None:
        """The next heartbeat is due: tell everybody the log, or resign."""
        core = self._core
        if core.leadership is None:
            return
        if self._leads_enough():
            core.activity.heartbeat_sent()
            self.commit_what_can_be()
            self._send_entries()
            core.timers.restart_heartbeat()
        else:
            core.log(logging.INFO, "resigning: not enough nodes answer")
            core.become_follower()
            core.leader_id = None
            core.timers.restart_election()

    def _leads_enough(self) -> bool:
        """Whether the followers that a leader needs are still there."""
        core = self._core
        assert core.leadership is not None
        electorate = core.electorate()
        if core.config.is_classic_mode():
            return core.has_majority(core.leadership.heard_since(core.lease_start_s()), electorate)
        return core.has_majority(electorate, electorate)

    def handle_entries_response(self, message: AppendEntriesResponse) -> None:
        """A follower answers."""
        core = self._core
        core.adopt_term(message.term)
        leadership = core.leadership
        if leadership is None or message.term != core.persistent.current_term:
            return
        follower, now_s = message.follower_id, core.environment.now_s()
        leadership.heard(follower, now_s)
        core.activity.detector.record_heartbeat_response(follower, True, (now_s - leadership.sent_s) * 1000)
        if message.success:
            leadership.matches(follower, message.term_number)
            self.commit_what_can_be()

    def commit_what_can_be(self) -> None:
        """Commit the entries that a majority has."""
        core = self._core
        leadership = core.leadership
        if leadership is None:
            return
        electorate = core.electorate()
        if core.has_majority(electorate, electorate):
            core.persistent.log.commit(leadership.committable(core.persistent.log, electorate))

    def _send_entries(self) -> None:
        core = self._core
        assert core.leadership is not None
        log = core.persistent.log
        active = sorted(core.active_nodes())
        core.leadership.sent_s = core.environment.now_s()
        core.outbox.broadcast(
            AppendEntries(
                core.persistent.current_term,
                core.node_id,
                {**dict.fromkeys(core.config.get_consensus_variables()), **log.values},
                log.last_index,
                len(active),
                active,
                log.base_index,
                log.base_term,
                log.entries,
            )
        )
