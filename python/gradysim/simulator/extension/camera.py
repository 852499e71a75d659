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

# Nodes on the edge of the cone are in the picture in spite of rounding; radians.
_EDGE = 1e-6


class DetectedNode(TypedDict):
    """A node in a picture: its position in meters. The type is always "node"."""

    position: Position
    type: str


@dataclass
class CameraConfiguration:
    """Cone that a camera sees. ValueError names an invalid value.

    Attributes:
        camera_reach: Largest distance of a visible node; m, >= 0.
        camera_theta: Angle between the axis of the cone and its side; degrees, 0 to 180.
        facing_elevation: Elevation of the axis: 0 up, 90 to the horizon, 180 down; degrees.
        facing_rotation: Rotation of the axis from x (North) towards y (East); degrees.
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
    """Camera of one node, in both modes. Prototype mode needs a mobility handler."""

    _warns_elsewhere = False

    def __init__(self, protocol: IProtocol, configuration: CameraConfiguration) -> None:
        """Attach a camera to the protocol's node.

        Raise ReferenceError if the protocol has no provider yet, as in its constructor. Raise RuntimeError if
        the positions of the nodes are unknown: in other environments, or without a mobility handler.
        """
        super().__init__(protocol)
        provider = provider_of(protocol)
        if not isinstance(provider, NodePositions):
            raise RuntimeError(
                "a camera works in prototype mode and in integrated mode, where the positions of the nodes "
                f"are known; this node runs in {mode_of(provider)}"
            )
        provider.node_positions()  # raises here, not at the first picture
        self._world = provider
        self._node_id = protocol.provider.get_id()
        # Subclasses written for 0.8 use these names and `_mobility`.
        self._configuration = checked_configuration(configuration, CameraConfiguration)
        self._camera_vector = _axis(configuration)
        self._camera_theta = math.radians(configuration.camera_theta)

    @property
    def _mobility(self) -> Any:
        """The mobility handler with all nodes. RuntimeError outside of prototype mode."""
        if self._provider is None:
            raise RuntimeError(
                f"{type(self).__name__} uses the nodes of the mobility handler of prototype mode; "
                "super().take_picture() returns the visible nodes in both modes"
            )
        return self._provider.handlers["mobility"]

    def take_picture(self) -> list[DetectedNode]:
        """Return the other nodes within reach and within the cone, in the order of creation.

        A node at the position of the camera is always visible.
        """
        positions = self._world.node_positions()
        own = positions[self._node_id]
        return [
            {"position": position, "type": "node"}
            for node_id, position in positions.items()
            if node_id != self._node_id and self._sees(own, position)
        ]

    def change_facing(self, facing_elevation: float, facing_rotation: float) -> None:
        """Turn the camera; degrees, as in `CameraConfiguration`. ValueError if one is not finite."""
        self._configuration = replace(
            self._configuration, facing_elevation=facing_elevation, facing_rotation=facing_rotation
        )
        self._camera_vector = _axis(self._configuration)

    def _sees(self, own: Position, position: Position) -> bool:
        dx, dy, dz = position[0] - own[0], position[1] - own[1], position[2] - own[2]
        distance = math.hypot(dx, dy, dz)
        if distance > self._configuration.camera_reach:
            return False
        if distance == 0:  # it has no direction; products of -0 and 0 would give one
            return True
        ax, ay, az = self._camera_vector
        # atan2 works for every angle; acos fails if its argument rounds to > 1.
        across = math.hypot(ay * dz - az * dy, az * dx - ax * dz, ax * dy - ay * dx)
        along = ax * dx + ay * dy + az * dz
        return math.atan2(across, along) - _EDGE <= self._camera_theta


def _axis(configuration: CameraConfiguration) -> tuple[float, float, float]:
    """Unit vector along the axis of the cone."""
    elevation = math.radians(configuration.facing_elevation)
    rotation = math.radians(configuration.facing_rotation)
    level = math.sin(elevation)
    return (level * math.cos(rotation), level * math.sin(rotation), math.cos(elevation))
