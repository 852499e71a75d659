"""UAVs of ZigZag, which relay the data of sensors to a ground station.

After T. Lamenza et al., "Developing Algorithms for the Internet of Flying Things Through Environments With
Varying Degrees of Realism". Each lesson that the authors drew is a parameter here: `heartbeat_jitter`,
`interaction_timeout`, `launch_interval`. The scenarios are in `configs/zigzag.ini`.
"""

from custody import Custody
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.plugin.mission_mobility import (
    LoopMission,
    MissionMobilityConfiguration,
    MissionMobilityPlugin,
)
from heartbeat import HeartbeatClock
from message import (
    GroundHeartbeat,
    PairConfirmation,
    PairRequest,
    SensorData,
    UavHeartbeat,
    decode,
    encode,
)


class ZigZagMobile(IProtocol):
    """Flies back and forth over the sensors, collects their readings and relays them to the ground station.

    All UAVs have the same mission: from the ground station over every sensor and back, in a loop. Each
    advertises itself with heartbeats. A UAV that hears the heartbeat of another requests an exchange, and the
    other confirms. Afterwards one of them, the *carrier*, has the data of both and flies towards the ground
    station. The other one has no data and flies away from it. So two UAVs that meet turn around, and the data
    flies on as if they had passed each other. The ground station takes part in the same way, except that it
    does not move: it is always the carrier.

    The carrier of two UAVs is the one that was flying outward. If both fly in the same direction, it is the
    one with the lower id. Request and confirmation name the carrier. So the two agree even if each has sent a
    request to the other.

    If messages get lost, no data is duplicated. The data of a lost message arrives with the next message
    between the same two nodes (see `custody.py`). After a lost request no UAV turns around. After a lost
    confirmation only its sender turns around. In both cases the two try again at a later heartbeat, if they
    still hear each other.

    Tracked variables:
        data: Readings that the UAV holds.
        collected: Readings received from sensors so far.
        interactions: Exchanges with UAVs and the ground station so far.
    """

    heartbeat_interval: float = 1.0
    """Seconds between two heartbeats."""
    heartbeat_jitter: float = 0.1
    """Longest random delay of a heartbeat in seconds; 0: all nodes send at the same instants."""
    interaction_timeout: float = 5.0
    """Seconds after the launch and after an exchange in which the UAV ignores other UAVs and the ground
    station, but not sensors, to leave their range. 0: two UAVs that meet turn around at each heartbeat."""
    launch_interval: float = 30.0
    """Seconds between the launches of two UAVs: number i starts at i * launch_interval; 0: all at once."""
    sensor_count: int = 5
    """Number of sensors, which stand on the x axis."""
    sensor_spacing: float = 300.0
    """Meters from the ground station, at x = 0, to the first sensor and from each sensor to the next."""
    altitude: float = 20.0
    """Meters above ground at which UAV 0 flies."""
    altitude_step: float = 1.0
    """Meters between the altitudes of two consecutive UAVs, so that they pass each other safely."""
    speed: float = 10.0
    """Meters per second."""

    def initialize(self) -> None:
        """Start without data, on the ground."""
        self._custody = Custody()
        self._collected = 0
        self._interactions = 0
        self._ignore_until = 0.0
        self._launched = False
        self._mission = MissionMobilityPlugin(
            self,
            MissionMobilityConfiguration(speed=self.speed, loop_mission=LoopMission.REVERSE),
        )
        launch_time = self.provider.get_id() * self.launch_interval
        self._heartbeats = HeartbeatClock(
            self.heartbeat_interval, self.heartbeat_jitter, start=launch_time, random=self.provider.random
        )
        self._track()
        self.provider.schedule_timer("launch", launch_time)

    def handle_timer(self, timer: str) -> None:
        """Launch or send a heartbeat, and schedule the next heartbeat."""
        if timer == "launch":
            self._launch()
        else:
            self._send_heartbeat()
        self.provider.schedule_timer("heartbeat", self._heartbeats.next())

    def handle_packet(self, message: str) -> None:
        """Collect the readings of sensors; exchange data with UAVs and the ground station."""
        if not self._launched:
            return
        match decode(message):
            case SensorData():
                self._custody.held += 1
                self._collected += 1
            case GroundHeartbeat(sender=station):
                self._ask(station, carrier=station)
            case UavHeartbeat(sender=peer, homeward=homeward, available=True):
                self._ask(peer, carrier=self._carrier_of_pair(peer, homeward))
            case PairRequest() as request:
                self._confirm(request)
            case PairConfirmation() as confirmation:
                self._conclude(confirmation)
        self._track()

    def _launch(self) -> None:
        height = self.altitude + self.provider.get_id() * self.altitude_step
        self._mission.start_mission(
            [(stop * self.sensor_spacing, 0.0, height) for stop in range(self.sensor_count + 1)]
        )
        self._launched = True
        self._leave_others_alone()

    def _send_heartbeat(self) -> None:
        heartbeat = UavHeartbeat(
            sender=self.provider.get_id(),
            homeward=self._mission.is_reversed,
            available=not self._ignores_others(),
        )
        self.provider.send_communication_command(BroadcastMessageCommand(encode(heartbeat)))

    def _carrier_of_pair(self, peer: int, peer_homeward: bool) -> int:
        """Return the UAV that flies outward; if both fly in the same direction, the one with the lower id."""
        me, me_homeward = self.provider.get_id(), self._mission.is_reversed
        if me_homeward == peer_homeward:
            return min(me, peer)
        return peer if me_homeward else me

    def _ask(self, peer: int, carrier: int) -> None:
        """Answer a heartbeat of `peer`."""
        if self._ignores_others():
            return
        given = self._hand_over(peer, carrier)
        self._send(PairRequest(self.provider.get_id(), carrier, given), peer)

    def _confirm(self, request: PairRequest) -> None:
        self._custody.take(request.sender, request.given)
        if self._ignores_others():
            return
        given = self._hand_over(request.sender, request.carrier)
        self._send(PairConfirmation(self.provider.get_id(), request.carrier, given), request.sender)
        self._part(request.carrier)

    def _conclude(self, confirmation: PairConfirmation) -> None:
        self._custody.take(confirmation.sender, confirmation.given)
        if not self._ignores_others():
            self._part(confirmation.carrier)

    def _hand_over(self, peer: int, carrier: int) -> int:
        """Hand all data to `peer` if it is the carrier. Returns the `given` of the message to it."""
        if peer == carrier:
            self._custody.give_all(peer)
        return self._custody.given_to(peer)

    def _part(self, carrier: int) -> None:
        """End an exchange: the carrier flies towards the ground station, the other one away from it."""
        self._mission.set_reversed(carrier == self.provider.get_id())
        self._leave_others_alone()
        self._interactions += 1

    def _leave_others_alone(self) -> None:
        self._ignore_until = self.provider.current_time() + self.interaction_timeout

    def _ignores_others(self) -> bool:
        return self.provider.current_time() < self._ignore_until

    def _send(self, message: PairRequest | PairConfirmation, destination: int) -> None:
        self.provider.send_communication_command(SendMessageCommand(encode(message), destination))

    def _track(self) -> None:
        tracked = self.provider.tracked_variables
        tracked["data"] = self._custody.held
        tracked["collected"] = self._collected
        tracked["interactions"] = self._interactions
