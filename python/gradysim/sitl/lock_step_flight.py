"""One node on simulated time: its autopilot, its vehicle and its pilot."""

import math
from collections.abc import Callable, Mapping

from gradysim.protocol.position import Position
from gradysim.sitl.fleet import Fleet
from gradysim.sitl.flown_node import FlownNode, ground_temperature, wind_mps
from gradysim.sitl.frame import autopilots_place, home_of
from gradysim.sitl.link import MavlinkLink, Message
from gradysim.sitl.lock_step import RATE_HZ, LockStepAutopilot
from gradysim.sitl.pilot import Pilot
from gradysim.sitl.preparation import prepare
from gradysim.sitl.quadcopter import HOVER_THRUST, THRUST_EXPO, Quadcopter
from gradysim.sitl.vehicle import Vehicle

_POSITIONS_HZ = 5.0
"""As often an autopilot tells its position: so finely it is known when it has arrived."""

_SETTLED_M, _SETTLED_MPS = 0.2, 0.1
"""Of a vehicle that hovers where it should: how far it is off, how fast it is."""

_PARAMETERS: Mapping[str, float] = {
    "SIM_RATE_HZ": RATE_HZ,
    "MOT_THST_EXPO": THRUST_EXPO,
    "MOT_THST_HOVER": HOVER_THRUST,
}
"""Of ArduCopter, as the vehicle is."""


class LockStepFlight:
    """Flies one node.

    Attributes:
        name: For people.
        autopilot: Its autopilot.
        vehicle: What is told to it, step by step.
        pilot: Takes orders, once it is prepared.
    """

    def __init__(
        self, node: FlownNode, reference: Position, on_text: Callable[[str, str], None] | None
    ) -> None:
        """Open the ports; `reference` and `on_text` are those of `Flights`."""
        self.name = node.name
        self._node = node
        self._home = home_of(reference, node.start)
        self._on_text = on_text
        self._link = MavlinkLink(node.name)
        self._link.on_message = self._note
        self.autopilot = LockStepAutopilot(self._link, Quadcopter(wind_mps(node.name, node.parameters)))
        self.vehicle = Vehicle(self._link)
        self.pilot = Pilot(self.vehicle, self._place_of, node.start, node.speed_mps)

    @property
    def position(self) -> Position:
        """Where the node is, (x, y, z) in metres."""
        north, east, down = self.autopilot.body.position_m
        x, y, _ = self._node.start
        return (x + north, y + east, 0.0 - down)

    @property
    def is_settled(self) -> bool:
        """Whether it is where it should be at the start, and stays there."""
        off_m = math.dist(self.position, self._node.start)
        return off_m <= _SETTLED_M and math.hypot(*self.autopilot.body.velocity_mps) <= _SETTLED_MPS

    def start(self, fleet: Fleet, timeout_s: float) -> None:
        """Start the autopilot's program, and wait until it stands at its first step."""
        process = fleet.start(
            self._node.name,
            self._node.id,
            self._home,
            mavlink_port=self.autopilot.mavlink_port,
            physics_port=self.autopilot.port,
            parameters={**_PARAMETERS, **ground_temperature(self._home[2]), **self._node.parameters},
        )
        self.autopilot.meet(process, timeout_s)

    async def prepare(self, timeout_s: float) -> None:
        """Take off and fly to the start; SitlError if a step fails, or takes longer than that."""
        await prepare(
            self.vehicle,
            self._place_of(self._node.start),
            position_hz=_POSITIONS_HZ,
            speed_mps=self._node.speed_mps,
            timeout_s=timeout_s,
            parameters=self._node.parameters,
        )

    def _place_of(self, point: Position) -> Position:
        x, y, _ = self._node.start
        return autopilots_place(self._home, (point[0] - x, point[1] - y, point[2]))

    def _note(self, message: Message) -> None:
        if self._on_text is not None and message.get_type() == "STATUSTEXT":
            self._on_text(self._node.name, message.text)
