import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.dispatcher import create_dispatcher
from gradysim.protocol.plugin.random_mobility import RandomMobilityConfig, RandomMobilityPlugin

FLIGHT = """
from gradysim.protocol.plugin.random_mobility import RandomMobilityPlugin

class Wanderer(Quiet):
    def initialize(self):
        self.targets = []
        self.plugin = RandomMobilityPlugin(self)
        self.plugin.initiate_random_trip()

    def handle_telemetry(self, telemetry):
        target = self.plugin.current_target
        if self.targets[-1:] != [target]:
            self.targets.append(target)

    def finish(self):
        self.provider.tracked_variables["targets"] = self.targets
"""

NODES = ["sim-time-limit = 60s", "*.uavs.count = 2", '*.uavs[*].protocol.class = "protocols.py:Wanderer"']


def arrive(protocol, plugin):
    protocol.handle_telemetry(Telemetry(plugin.current_target))


def test_the_defaults_are_the_published_ones():
    assert RandomMobilityConfig() == RandomMobilityConfig((-50, 50), (-50, 50), (0, 50), 1)


def test_before_a_trip_there_is_none(protocol):
    plugin = RandomMobilityPlugin(protocol)
    assert (plugin.trip_ongoing, plugin.current_target) == (False, None)


def test_finishing_no_trip_does_nothing(protocol):
    RandomMobilityPlugin(protocol).finish_random_trip()
    assert protocol.provider.commands == []


def test_travelling_goes_where_it_says(protocol):
    target = RandomMobilityPlugin(protocol).travel_to_random_waypoint()
    assert protocol.provider.targets == [target]


def test_travelling_is_no_trip(protocol):
    plugin = RandomMobilityPlugin(protocol)
    target = plugin.travel_to_random_waypoint()
    assert (plugin.trip_ongoing, plugin.current_target) == (False, None)
    protocol.handle_telemetry(Telemetry(target))
    assert protocol.provider.targets == [target]


def test_a_trip_starts_at_once(protocol):
    plugin = RandomMobilityPlugin(protocol)
    plugin.initiate_random_trip()
    assert plugin.trip_ongoing
    assert protocol.provider.targets == [plugin.current_target]


def test_a_trip_goes_on_where_a_target_is_reached(protocol):
    plugin = RandomMobilityPlugin(protocol)
    plugin.initiate_random_trip()
    arrive(protocol, plugin)
    arrive(protocol, plugin)
    assert len(set(protocol.provider.targets)) == 3
    assert protocol.provider.targets[-1] == plugin.current_target


def test_initiating_twice_is_initiating_once(protocol):
    plugin = RandomMobilityPlugin(protocol)
    plugin.initiate_random_trip()
    plugin.initiate_random_trip()
    arrive(protocol, plugin)
    assert len(protocol.provider.targets) == 2


def test_finishing_clears_the_target_and_sends_nothing(protocol):
    plugin = RandomMobilityPlugin(protocol)
    plugin.initiate_random_trip()
    target = plugin.current_target
    plugin.finish_random_trip()
    protocol.handle_telemetry(Telemetry(target))
    assert (plugin.trip_ongoing, plugin.current_target) == (False, None)
    assert protocol.provider.targets == [target]


def test_after_a_trip_comes_another(protocol):
    plugin = RandomMobilityPlugin(protocol)
    plugin.initiate_random_trip()
    plugin.finish_random_trip()
    plugin.initiate_random_trip()
    arrive(protocol, plugin)
    assert len(protocol.provider.targets) == 3


def test_a_trip_ended_by_an_earlier_handler_sends_nothing_for_that_telemetry(protocol):
    plugin = RandomMobilityPlugin(protocol)
    plugin.initiate_random_trip()
    create_dispatcher(protocol).register_handle_telemetry(lambda _p, _t: plugin.finish_random_trip())
    arrive(protocol, plugin)
    assert len(protocol.provider.targets) == 1


def test_travelling_during_a_trip_changes_its_target(protocol):
    plugin = RandomMobilityPlugin(protocol)
    plugin.initiate_random_trip()
    assert plugin.travel_to_random_waypoint() == plugin.current_target
    arrive(protocol, plugin)
    assert len(protocol.provider.targets) == 3


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize(("distance", "waypoints"), [(2, 2), (-2, 2), (2.01, 1), (-2.01, 1)])
def test_a_target_is_reached_within_the_tolerance(protocol, axis, distance, waypoints):
    RandomMobilityPlugin(
        protocol, RandomMobilityConfig(x_range=(5, 5), y_range=(6, 6), z_range=(7, 7), tolerance=2)
    ).initiate_random_trip()
    position = [5, 6, 7]
    position[axis] += distance
    protocol.handle_telemetry(Telemetry(tuple(position)))
    assert len(protocol.provider.targets) == waypoints


def test_the_protocol_still_gets_its_telemetry(protocol):
    plugin = RandomMobilityPlugin(protocol)
    plugin.initiate_random_trip()
    arrive(protocol, plugin)
    assert [name for name, *_ in protocol.calls] == ["handle_telemetry"]


@pytest.mark.parametrize("name", ["x_range", "y_range", "z_range"])
@pytest.mark.parametrize(
    "value", [(1, 0), (0, math.nan), (0, math.inf), (0,), (0, 1, 2), 5, None, ("low", "high")]
)
def test_a_bad_range_is_refused(protocol, name, value):
    with pytest.raises(ValueError, match=name):
        RandomMobilityPlugin(protocol, RandomMobilityConfig(**{name: value}))


def test_without_tolerance_a_target_is_reached_at_its_very_point(protocol):
    plugin = RandomMobilityPlugin(protocol, RandomMobilityConfig(tolerance=0))
    plugin.initiate_random_trip()
    arrive(protocol, plugin)
    assert len(protocol.provider.targets) == 2


@pytest.mark.parametrize("tolerance", [-1, math.nan, math.inf, "1"])
def test_a_bad_tolerance_is_refused(protocol, tolerance):
    with pytest.raises(ValueError, match="tolerance"):
        RandomMobilityPlugin(protocol, RandomMobilityConfig(tolerance=tolerance))


ranges = st.tuples(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6)).map(sorted)


@given(st.tuples(ranges, ranges, ranges), st.integers(), st.integers(0, 100))
def test_waypoints_lie_in_the_box_and_follow_from_seed_and_node(make_protocol, box, seed, node_id):
    def waypoints():
        protocol = make_protocol(seed=seed, node_id=node_id)
        plugin = RandomMobilityPlugin(protocol, RandomMobilityConfig(*box))
        return [plugin.travel_to_random_waypoint() for _ in range(5)]

    first = waypoints()
    assert all(
        lowest <= x <= highest for point in first for (lowest, highest), x in zip(box, point, strict=True)
    )
    assert first == waypoints()


def test_nodes_draw_different_waypoints(make_protocol):
    one, other = (RandomMobilityPlugin(make_protocol(node_id=node_id)) for node_id in range(2))
    assert one.travel_to_random_waypoint() != other.travel_to_random_waypoint()


def test_seeds_draw_different_waypoints(make_protocol):
    one, other = (RandomMobilityPlugin(make_protocol(seed=seed)) for seed in range(2))
    assert one.travel_to_random_waypoint() != other.travel_to_random_waypoint()


def test_a_trip_in_a_simulation(make_scenario, run_mode):
    for position, tracked in run_mode(make_scenario(FLIGHT, *NODES)):
        assert len(tracked["targets"]) > 5
        assert all(-50 <= x <= 50 and -50 <= y <= 50 and 0 <= z <= 50 for x, y, z in tracked["targets"])
        assert position != (0, 0, 0)


def test_both_modes_fly_the_same_trip(make_scenario, run_prototype, run_integrated):
    scenario = make_scenario(FLIGHT, *NODES)
    assert [node.tracked_variables for node in run_prototype(scenario)] == [
        node.tracked_variables for node in run_integrated(scenario)
    ]


def test_what_the_protocol_draws_on_the_way_makes_no_difference(protocol):
    trips = []
    for draws in (0, 3):
        protocol.provider.random.seed(1)
        plugin = RandomMobilityPlugin(protocol)
        targets = []
        for _ in range(3):
            targets.append(plugin.travel_to_random_waypoint())
            for _ in range(draws):
                protocol.provider.random.random()
        trips.append(targets)
    assert trips[0] == trips[1]
    assert len(set(trips[0])) == 3
