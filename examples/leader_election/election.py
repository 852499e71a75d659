"""Two ways to elect a leader: the bully algorithm without retries, and Raft."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.plugin.raft import RaftConfig, RaftConsensusPlugin, RaftMode


class Bully(IProtocol):
    """Announces its id at the start, and takes the lead if it hears no higher one in the next second.

    Tracked variables:
        leads: 1 if this node takes itself for the leader, else 0.
    """

    wait: float = 0.0
    """Seconds: the announcement is up to this much late, at random."""

    def initialize(self) -> None:
        """Announce the id one second after the start."""
        self._highest = self.provider.get_id()
        self.provider.tracked_variables["leads"] = 0
        self.provider.schedule_timer("announce", 1 + self.provider.random.uniform(0, self.wait))
        self.provider.schedule_timer("decide", 2 + self.wait)

    def handle_timer(self, timer: str) -> None:
        """Announce, or decide."""
        own = self.provider.get_id()
        if timer == "announce":
            self.provider.send_communication_command(BroadcastMessageCommand(str(own)))
        else:
            self.provider.tracked_variables["leads"] = int(self._highest == own)

    def handle_packet(self, message: str) -> None:
        """Remember the highest id."""
        self._highest = max(self._highest, int(message))


class RaftMember(IProtocol):
    """Elects a leader with the plugin, and looks once a second whether it is the one.

    Tracked variables:
        leads: 1 if this node is the leader, else 0.
    """

    members: int = 20
    """Number of nodes, with the ids from 0."""

    def initialize(self) -> None:
        """Start the plugin."""
        config = RaftConfig().add_consensus_variable("departure_s", float).set_logging(False)
        config.set_raft_mode(RaftMode.CLASSIC).set_election_timeout(300, 600).set_heartbeat_interval(100)
        self._raft = RaftConsensusPlugin(config, self)
        self._raft.set_known_nodes(list(range(self.members)))
        self._raft.start()
        self.provider.tracked_variables["leads"] = 0
        self.provider.schedule_timer("look", 1)

    def handle_timer(self, timer: str) -> None:
        """Look who leads."""
        self.provider.tracked_variables["leads"] = int(self._raft.is_leader())
        self.provider.schedule_timer("look", self.provider.current_time() + 1)

    def handle_packet(self, message: str) -> None:
        """Do nothing: the plugin handles its messages."""
