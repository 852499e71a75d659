"""Plugin that sends a node to random points of a box, once or on a trip from one to the next."""

import logging
from dataclasses import dataclass
from random import Random

from gradysim.protocol.checked_values import checked_number, checked_range
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.attachment import (
    configuration_or_default,
    stream_of,
    warn_without_telemetry,
)
from gradysim.protocol.plugin.dispatcher import create_dispatcher
from gradysim.protocol.position import Position

_logger = logging.getLogger(__name__)


@dataclass
class RandomMobilityConfig:
    """The box from which waypoints are drawn uniformly, and the tolerance of a trip.

    Attributes:
        x_range: (lowest, highest) x; m.
        y_range: The same for y.
        z_range: The same for z.
        tolerance: A waypoint counts as reached at this distance or less; m, >= 0.
    """

    x_range: tuple[float, float] = (-50, 50)
    y_range: tuple[float, float] = (-50, 50)
    z_range: tuple[float, float] = (0, 50)
    tolerance: float = 1


class RandomMobilityPlugin:
    """Draws waypoints from a random stream of its own. The same seed gives the same waypoints in every mode.

    The stream is seeded by one number of `provider.random`, when the plugin is created or, if the protocol
    does not have a provider yet, at the first waypoint. Other draws of the protocol after that make no
    difference.

    A trip goes from waypoint to waypoint at the vehicle's speed. The node's telemetry drives it.
    """

    def __init__(self, protocol: IProtocol, config: RandomMobilityConfig | None = None) -> None:
        """Attach to `protocol`; without a configuration its defaults hold.

        ValueError if a range is not two finite numbers in ascending order, or the tolerance is negative.
        """
        config = configuration_or_default(self, config, RandomMobilityConfig)
        self._protocol = protocol
        self._ranges = tuple(
            checked_range(name, getattr(config, name), ValueError)
            for name in ("x_range", "y_range", "z_range")
        )
        tolerance = checked_number("tolerance", config.tolerance, 0, unit="m")
        self._squared_tolerance = tolerance * tolerance
        self._random: Random | None = None
        if getattr(protocol, "provider", None) is not None:
            self._stream()
        self._dispatcher = create_dispatcher(protocol)
        self._target: Position | None = None

    @property
    def trip_ongoing(self) -> bool:
        """Whether a trip is in progress."""
        return self._target is not None

    @property
    def current_target(self) -> Position | None:
        """Current waypoint of the trip, (x, y, z) in meters; None without a trip."""
        return self._target

    def travel_to_random_waypoint(self) -> Position:
        """Send the vehicle to a new random waypoint, and return it: (x, y, z) in meters.

        During a trip it replaces the trip's target.
        """
        stream = self._stream()
        x, y, z = (stream.uniform(lowest, highest) for lowest, highest in self._ranges)
        _logger.info("Random mobility: Going to (%.2f, %.2f, %.2f)", x, y, z)
        self._protocol.provider.send_mobility_command(GotoCoordsMobilityCommand(x, y, z))
        if self.trip_ongoing:
            self._target = (x, y, z)
        return (x, y, z)

    def initiate_random_trip(self) -> None:
        """Fly to random waypoints, one after another, until `finish_random_trip`; no-op during a trip."""
        if self.trip_ongoing:
            return
        self._target = self.travel_to_random_waypoint()
        self._dispatcher.register_handle_telemetry(self._handle_telemetry)
        warn_without_telemetry(
            _logger, self._protocol, "a random trip does not get beyond its first waypoint"
        )

    def finish_random_trip(self) -> None:
        """End the trip; no-op without one. The vehicle still flies to its last target."""
        if not self.trip_ongoing:
            return
        self._dispatcher.unregister_handle_telemetry(self._handle_telemetry)
        self._target = None

    def _stream(self) -> Random:
        if self._random is None:
            self._random = Random(stream_of(self._protocol.provider).getrandbits(64))
        return self._random

    def _handle_telemetry(self, _protocol: IProtocol, telemetry: Telemetry) -> None:
        # A handler before this one may have ended the trip.
        if self._target is not None:
            # squared_distance, inlined: this runs at every telemetry of every vehicle.
            x, y, z = telemetry.current_position
            target_x, target_y, target_z = self._target
            dx, dy, dz = x - target_x, y - target_y, z - target_z
            if dx * dx + dy * dy + dz * dz <= self._squared_tolerance:
                self.travel_to_random_waypoint()
