"""A camera that sees other nodes."""

import math
from dataclasses import dataclass, replace
from typing import Any, TypedDict

from gradysim.encapsulator.interface import NodePositions
from gradysim.protocol.checked_values import checked_number
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.position import Position
from gradysim.simulator.extension.extension import Extension, mode_of, provider_of
from gradysim.simulator.validation import checked_configuration

# Nodes on the very edge of the cone are in the picture, whatever the rounding; radians.
_EDGE = 1e-6


class DetectedNode(TypedDict):
    """What is known of something in a picture: its position in metres; the type of all there is is "node"."""

    position: Position
    type: str


@dataclass
class CameraConfiguration:
    """A cone in which the camera sees. ValueError names a wrong value.

    Attributes:
        camera_reach: How far it sees; m, >= 0.
        camera_theta: Angle between the axis of the cone and its side; degrees, 0 to 180.
        facing_elevation: Where the axis points: 0 up, 90 to the horizon, 180 down; degrees.
        facing_rotation: From x (North) towards y (East); degrees.
    """

    camera_reach: float
    camera_theta: float
    facing_elevation: float
    facing_rotation: float

    def __post_init__(self) -> None:
        checked_number("camera_reach", self.camera_reach, 0, infinite=True, unit="m")
        checked_number("camera_theta", self.camera_theta, 0, 180, unit="degrees")
        for name in ("facing_elevation", "facing_rotation"):
            checked_number(name, getattr(self, name), unit="degrees")


class CameraHardware(Extension):
    """The camera of one node, in prototype mode (it needs a mobility handler) and in integrated mode."""

    _warns_elsewhere = False

    def __init__(self, protocol: IProtocol, configuration: CameraConfiguration) -> None:
        """Put a camera on the protocol's node.

        Raise ReferenceError if the protocol has no provider yet, as in its constructor, and RuntimeError if
        nobody knows where the nodes are: not in this mode, or without a mobility handler.
        """
        super().__init__(protocol)
        provider = provider_of(protocol)
        if not isinstance(provider, NodePositions):
            raise RuntimeError(
                "a camera works in prototype mode and in integrated mode, where the positions of the nodes "
                f"are known; this node runs in {mode_of(provider)}"
            )
        provider.node_positions()  # Says now what is missing, not at the first picture.
        self._world = provider
        self._node_id = protocol.provider.get_id()
        # These names, and `_mobility`, are what cameras of one's own that derive from this one look with.
        self._configuration = checked_configuration(configuration, CameraConfiguration)
        self._camera_vector = _axis(configuration)
        self._camera_theta = math.radians(configuration.camera_theta)

    @property
    def _mobility(self) -> Any:
        """The mobility handler, whose `nodes` are all there are. RuntimeError if not in prototype mode."""
        if self._provider is None:
            raise RuntimeError(
                f"{type(self).__name__} looks at the nodes of the mobility handler, which there is in "
                "prototype mode only; super().take_picture() tells in both modes what is seen"
            )
        return self._provider.handlers["mobility"]

    def take_picture(self) -> list[DetectedNode]:
        """Return the other nodes within reach and within the cone, in the order of their making.

        A node at the very place of the camera is always seen.
        """
        positions = self._world.node_positions()
        place = positions[self._node_id]
        return [
            {"position": position, "type": "node"}
            for node_id, position in positions.items()
            if node_id != self._node_id and self._sees(place, position)
        ]

    def change_facing(self, facing_elevation: float, facing_rotation: float) -> None:
        """Turn the camera; degrees, as in `CameraConfiguration`. ValueError if one is not finite."""
        self._configuration = replace(
            self._configuration, facing_elevation=facing_elevation, facing_rotation=facing_rotation
        )
        self._camera_vector = _axis(self._configuration)

    def _sees(self, place: Position, position: Position) -> bool:
        dx, dy, dz = position[0] - place[0], position[1] - place[1], position[2] - place[2]
        distance = math.hypot(dx, dy, dz)
        if distance > self._configuration.camera_reach:
            return False
        if distance == 0:  # which has no direction: products of -0 and 0 would tell one
            return True
        ax, ay, az = self._camera_vector
        # The arcus tangent knows every angle; the arcus cosine fails where its argument rounds to > 1.
        across = math.hypot(ay * dz - az * dy, az * dx - ax * dz, ax * dy - ay * dx)
        along = ax * dx + ay * dy + az * dz
        return math.atan2(across, along) - _EDGE <= self._camera_theta


def _axis(configuration: CameraConfiguration) -> tuple[float, float, float]:
    """Unit vector along the axis of the cone."""
    elevation = math.radians(configuration.facing_elevation)
    rotation = math.radians(configuration.facing_rotation)
    level = math.sin(elevation)
    return (level * math.cos(rotation), level * math.sin(rotation), math.cos(elevation))
