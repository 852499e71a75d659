import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from gradysim.encapsulator.python import PythonEncapsulator
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.simulator.event import EventLoop
from gradysim.simulator.extension.camera import CameraConfiguration, CameraHardware
from gradysim.simulator.handler.mobility import (
    DynamicVelocityMobilityConfiguration,
    DynamicVelocityMobilityHandler,
    MobilityHandler,
)
from gradysim.simulator.node import Node
from python.quiet_protocol import Quiet

POINTS = {
    "camera": (0, 0, 0),
    "north": (5, 0, 0),
    "east": (0, 5, 0),
    "south": (-5, 0, 0),
    "up": (0, 0, 5),
    "down": (0, 0, -5),
    "same": (0, 0, 0),
    "far": (0, 0, 11),
    "slanting": (0, 5, 5),
}
NAMES = {point: name for name, point in POINTS.items() if name != "camera"}


@pytest.fixture
def see(protocols):
    """Take a picture with a camera at the origin, among POINTS; its reach is 10 m."""

    def look(theta, elevation, rotation):
        protocol, *_ = protocols(POINTS.values(), MobilityHandler())
        camera = CameraHardware(protocol, CameraConfiguration(10, theta, elevation, rotation))
        return [NAMES[node["position"]] for node in camera.take_picture()]

    return look


@pytest.mark.parametrize(
    ("elevation", "rotation", "seen"),
    [
        (0, 0, ["up", "same"]),
        (180, 0, ["down", "same"]),
        (90, 0, ["north", "same"]),
        (90, 90, ["east", "same"]),
        (90, 180, ["south", "same"]),
        (45, 90, ["same", "slanting"]),
    ],
)
def test_where_it_faces(see, elevation, rotation, seen):
    assert see(30, elevation, rotation) == seen


def test_the_edge_of_the_cone_is_seen(see):
    assert see(30, 15, 90) == ["up", "same", "slanting"]


def test_with_the_widest_cone_everything_in_reach_is_seen(see):
    assert see(180, 0, 0) == ["north", "east", "south", "up", "down", "same", "slanting"]


@pytest.mark.parametrize("place", [(100, 0, 0), (0, 100, 0), (0, 0, 100)])
@pytest.mark.parametrize(("x", "seen"), [(5, 1), (-5, 0), (0, 1)])
def test_it_looks_from_where_it_is(protocols, place, x, seen):
    protocol, *_ = protocols([place, (place[0] + x, *place[1:])], MobilityHandler())
    camera = CameraHardware(protocol, CameraConfiguration(10, 30, 90, 0))
    assert len(camera.take_picture()) == seen


@pytest.mark.parametrize("elevation", [45, 135])
@pytest.mark.parametrize("rotation", [45, 135, 225, 315])
def test_a_node_at_its_own_place_is_seen_wherever_it_looks(see, elevation, rotation):
    assert "same" in see(1, elevation, rotation)


def test_what_is_known_of_a_node(protocols):
    protocol, *_ = protocols([(0, 0, 0), (0, 0, 1)], MobilityHandler())
    camera = CameraHardware(protocol, CameraConfiguration(10, 30, 0, 0))
    assert camera.take_picture() == [{"position": (0, 0, 1), "type": "node"}]


@pytest.mark.parametrize(("distance", "seen"), [(10, 1), (10.001, 0)])
def test_it_sees_as_far_as_its_reach(protocols, distance, seen):
    protocol, *_ = protocols([(0, 0, 0), (0, 0, distance)], MobilityHandler())
    assert len(CameraHardware(protocol, CameraConfiguration(10, 30, 0, 0)).take_picture()) == seen


def test_it_can_be_turned(protocols):
    protocol, *_ = protocols(POINTS.values(), MobilityHandler())
    camera = CameraHardware(protocol, CameraConfiguration(10, 30, 0, 0))
    camera.change_facing(90, 90)
    assert [NAMES[node["position"]] for node in camera.take_picture()] == ["east", "same"]


def test_it_sees_where_nodes_are_now(simulation):
    running = simulation([(0, 0, 0), (100, 0, 0)], MobilityHandler())
    protocol, other = (node.protocol_encapsulator.protocol for node in running.nodes)
    camera = CameraHardware(protocol, CameraConfiguration(10, 30, 90, 0))
    before = camera.take_picture()
    other.provider.send_mobility_command(GotoCoordsMobilityCommand(5, 0, 0))
    while running.current_time < 10:
        running.step_simulation()
    running.finalize()
    assert (before, [node["position"] for node in camera.take_picture()]) == ([], [(5, 0, 0)])


def test_any_mobility_handler_will_do(protocols):
    configuration = DynamicVelocityMobilityConfiguration(0.1, 1, 1, 1, 1)
    protocol, _ = protocols([(0, 0, 0), (0, 0, 1)], DynamicVelocityMobilityHandler(configuration))
    assert len(CameraHardware(protocol, CameraConfiguration(10, 30, 0, 0)).take_picture()) == 1


@example((3e-308, 3e-308, 3e-308), 0, 0)
@given(st.tuples(*[st.floats(-1e3, 1e3, allow_subnormal=False)] * 3), st.floats(0, 180), st.floats(-360, 360))
def test_what_it_points_at_is_seen(protocols_at, direction, theta, distance):
    x, y, z = direction
    protocol, *_ = protocols_at([(0, 0, 0), direction])
    elevation = math.degrees(math.atan2(math.hypot(x, y), z))
    rotation = math.degrees(math.atan2(y, x))
    camera = CameraHardware(protocol, CameraConfiguration(1e4, theta, elevation, rotation))
    assert len(camera.take_picture()) == 1


@pytest.fixture(scope="module")
def protocols_at(idle):
    """Like `protocols`, wired by hand, for the examples of a property."""

    def make(points):
        handler, made = MobilityHandler(), []
        handler.inject(EventLoop())
        for identifier, point in enumerate(points):
            node = Node()
            node.id, node.position = identifier, point
            node.protocol_encapsulator = PythonEncapsulator(node, mobility=handler)
            node.protocol_encapsulator.encapsulate(idle)
            handler.register_node(node)
            made.append(node.protocol_encapsulator.protocol)
        return made

    return make


def test_without_a_mobility_handler_it_cannot_be(protocols):
    with pytest.raises(RuntimeError):
        CameraHardware(*protocols([(0, 0, 0)]), CameraConfiguration(10, 30, 0, 0))


def test_where_positions_are_unknown_the_error_names_the_mode(hosted):
    with pytest.raises(RuntimeError, match="InteropProvider"):
        CameraHardware(hosted, CameraConfiguration(10, 30, 0, 0))


@pytest.mark.parametrize(
    ("wrong", "name"),
    [
        ((-1, 30, 0, 0), "camera_reach"),
        ((math.nan, 30, 0, 0), "camera_reach"),
        ((10, -1, 0, 0), "camera_theta"),
        ((10, 181, 0, 0), "camera_theta"),
        ((10, 30, math.inf, 0), "facing_elevation"),
        ((10, 30, 0, "north"), "facing_rotation"),
    ],
)
def test_wrong_values_are_refused_by_name(wrong, name):
    with pytest.raises(ValueError, match=name):
        CameraConfiguration(*wrong)


def test_it_cannot_be_turned_to_nowhere(protocols):
    camera = CameraHardware(*protocols([(0, 0, 0)], MobilityHandler()), CameraConfiguration(10, 30, 0, 0))
    with pytest.raises(ValueError, match="facing_rotation"):
        camera.change_facing(0, math.nan)


class Thermal(CameraHardware):
    """A user's camera: it sees warm nodes at any distance from the axis, and their temperature."""

    def take_picture(self):
        assert self._camera_vector == pytest.approx((0, 0, -1))
        assert self._camera_theta == pytest.approx(math.pi / 4)
        place = self._provider.node.position
        return [
            {"warmth": node.protocol_encapsulator.protocol.warmth, "type": node.id}
            for node in self._mobility.nodes.values()
            if math.dist(place, node.position) <= self._configuration.camera_reach
        ]


class Warm(Quiet):
    warmth = 37


def test_a_camera_of_ones_own_finds_the_nodes_and_their_protocols(protocols):
    protocol, *_ = protocols([(0, 0, 0), (5, 0, 0), (50, 0, 0)], MobilityHandler(), protocol=Warm)
    camera = Thermal(protocol, CameraConfiguration(10, 45, 180, 0))
    assert camera.take_picture() == [{"warmth": 37, "type": 0}, {"warmth": 37, "type": 1}]
