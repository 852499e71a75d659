import re
from dataclasses import replace

import pytest

from gradysim.prototype.run import run
from gradysim.prototype.simulation import build_simulation, communication_handler, mobility_handler
from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.scenario import CommunicationMediumSpec
from gradysim.scenario.schema.keys import ARDUPILOT, MOBILITY_KEYS
from gradysim.scenario.schema.values import Setting
from python.recorded_protocols import COUNTER, EARLY, FLYING, vectors_of

TYPENAME = next(key for key in MOBILITY_KEYS if key.path == "mobility.typename")


def run_of(scenario):
    simulator, _ = build_simulation(scenario)
    simulator.start_simulation()
    return [node.protocol_encapsulator.provider.tracked_variables for node in simulator.nodes]


COUNTING = (
    "class Tested(Quiet):\n"
    "    count = 0\n"
    "    def handle_telemetry(self, telemetry):\n"
    "        self.count += 1\n"
    '        self.provider.tracked_variables["count"] = self.count\n'
)

TIMING = (
    "class Tested(Quiet):\n"
    "    def initialize(self): self.times = self.provider.tracked_variables['times'] = []\n"
    "    def handle_telemetry(self, telemetry): self.times.append(self.provider.current_time())\n"
)


def test_nodes_in_the_order_of_ids_where_they_start(make_scenario):
    simulator, _ = build_simulation(make_scenario())
    assert [(node.id, node.position) for node in simulator.nodes] == [(0, (0, 0, 0)), (1, (10, 0, 0))]


def test_the_seed_of_the_run(make_scenario):
    simulator, _ = build_simulation(make_scenario("class Tested(Quiet): pass", "seed-set = 12"))
    assert simulator.seed == 12


def test_telemetry_interval_per_node(make_scenario):
    scenario = make_scenario(COUNTING, "*.uavs[1].mobility.telemetryInterval = 1s")
    assert run_of(scenario) == [{"count": 4}, {"count": 2}]


def test_no_telemetry(make_scenario):
    assert run_of(make_scenario(COUNTING, "*.uavs[1].mobility.telemetryInterval = 0s")) == [{"count": 4}, {}]


def test_a_stationary_node_refuses_to_move(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    def initialize(self):\n"
        "        self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 0, 100))",
        '*.uavs[*].mobility.typename = "StationaryMobility"',
    )
    with pytest.raises(Exception, match="GotoCoords"):
        run_of(scenario)


@pytest.mark.parametrize("typename", re.findall(r'"(\w+)"', TYPENAME.kind.expected))
def test_each_way_to_move_is_known(flown_scenario, make_scenario, typename):
    settings = [f'*.uavs[0].mobility.typename = "{typename}"', "*.uavs[0].mobility.separationX = 10m"]
    settings += ["*.uavs[0].mobility.r = 10m"]
    settings += [f"*.uavs[0].mobility.constraintAreaM{end} = 0m" for end in ("inX", "inY")]
    settings += [f"*.uavs[0].mobility.constraintAreaM{end} = 9m" for end in ("axX", "axY")]
    make, of_it = (flown_scenario, ()) if typename == ARDUPILOT else (make_scenario, settings)
    build_simulation(make("class Tested(Quiet): pass", *of_it))


def test_a_way_to_move_that_it_does_not_have_is_refused(make_scenario):
    scenario = make_scenario("class Tested(Quiet): pass", '*.uavs[1].mobility.typename = "MasslessMobility"')
    other, spec = scenario.nodes
    typename = replace(spec.mobility["typename"], value="MassMobility")
    nodes = (other, replace(spec, mobility={"typename": typename}))
    with pytest.raises(ConfigError, match="MassMobility"):
        build_simulation(replace(scenario, nodes=nodes))


def test_parameters_are_in_force_when_the_protocol_is_made(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    pace = 1\n"
        "    def __init__(self): self.seen = self.pace\n"
        '    def initialize(self): self.provider.tracked_variables["seen"] = self.seen',
        "*.uavs[1].protocol.pace = 5",
    )
    assert run_of(scenario) == [{"seen": 1}, {"seen": 5}]


def test_geographic_coordinates_are_relative_to_the_scenes_origin(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    def initialize(self):\n"
        "        self.provider.send_mobility_command(GotoGeoCoordsMobilityCommand(10, 20, 5))",
        "*.coordinateSystem.sceneLatitude = 10deg",
        "*.coordinateSystem.sceneLongitude = 20deg",
    )
    simulator, _ = build_simulation(scenario)
    simulator.start_simulation()
    assert simulator.nodes[1].position == pytest.approx((0, 0, 5))


@pytest.mark.parametrize(
    ("interval", "times_s"), [("5ms", (0.005, 0.01, 0.015)), ("3ms", (0.003, 0.006, 0.009))]
)
def test_telemetry_more_often_than_positions_are_updated_by_default(make_scenario, interval, times_s):
    setting = f"*.uavs[1].mobility.telemetryInterval = {interval}"
    (_, result) = run_of(make_scenario(TIMING, setting, "sim-time-limit = 0.5s"))
    assert result["times"][:3] == pytest.approx(times_s)


def test_nodes_beside_one_with_telemetry_more_often_keep_theirs(make_scenario):
    frequent = "*.uavs[1].mobility.telemetryInterval = 2ms"
    settings = "sim-time-limit = 0.1s", "*.uavs[0].mobility.telemetryInterval = default"
    beside, alone = (run_of(make_scenario(TIMING, *settings, *more))[0] for more in ([frequent], []))
    assert beside["times"] == alone["times"]
    assert len(alone["times"]) == 10


def test_vehicles_move_as_often_as_any_is_told_its_place(make_scenario):
    (_, result) = run_of(
        make_scenario(
            "class Tested(Quiet):\n"
            "    def initialize(self):\n"
            "        self.track = self.provider.tracked_variables['track'] = []\n"
            "        self.provider.send_mobility_command(GotoCoordsMobilityCommand(10, 100, 0))\n"
            "    def handle_telemetry(self, telemetry): self.track.append(telemetry.current_position[1])",
            "*.uavs[1].mobility.telemetryInterval = 5ms",
            "**.mobility.speed = 10mps",
        )
    )
    assert result["track"][:3] == pytest.approx([0.05, 0.1, 0.15])


def test_a_telemetry_interval_below_the_limit_is_an_error_at_its_setting(make_scenario):
    setting = "*.uavs[*].mobility.telemetryInterval"
    with pytest.raises(ConfigError) as error:
        build_simulation(make_scenario("class Tested(Quiet): pass", f"{setting} = 1ns"))
    assert error.value.key == setting


def test_beside_autopilots_positions_are_updated_as_often_as_these_fly_on(flown_scenario):
    setting = "*.uavs[1].mobility.telemetryInterval"
    with pytest.raises(ConfigError) as error:
        mobility_handler(flown_scenario("class Tested(Quiet): pass", f"{setting} = 5ms"))
    assert error.value.key == setting


@pytest.mark.parametrize(("wrong", "value"), [("speed_mps", -1.0), ("telemetry_interval_s", 1e-9)])
def test_of_speed_and_telemetry_interval_the_one_that_is_wrong_is_named(make_scenario, wrong, value):
    scenario = make_scenario("class Tested(Quiet): pass")
    right = {"speed_mps": 5.0, "telemetry_interval_s": 1.0}
    mobility = {
        field: Setting(number, Source(scenario.file, 0, field))
        for field, number in (right | {wrong: value}).items()
    }
    nodes = tuple(replace(node, mobility=mobility) for node in scenario.nodes)
    with pytest.raises(ConfigError) as error:
        build_simulation(replace(scenario, nodes=nodes))
    assert error.value.key == wrong


def test_the_medium(make_scenario):
    scenario = make_scenario("class Tested(Quiet): pass", "*.communicationMedium.transmissionRange = 30m")
    assert communication_handler(scenario).default_medium.transmission_range == 30


def test_each_node_has_the_range_of_its_radio(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet):\n"
        "    def initialize(self):\n"
        "        self.provider.tracked_variables['heard'] = []\n"
        "        greeting = BroadcastMessageCommand(str(self.provider.get_id()))\n"
        "        self.provider.send_communication_command(greeting)\n"
        "    def handle_packet(self, message):\n"
        "        self.provider.tracked_variables['heard'].append(message)\n",
        "*.uavs[0].wlan[*].radio.transmitter.communicationRange = 10m",
        "*.uavs[1].wlan[*].radio.transmitter.communicationRange = 9.9m",
    )
    assert run_of(scenario) == [{"heard": []}, {"heard": ["0"]}]


def test_a_medium_that_a_script_got_wrong_is_refused(make_scenario):
    scenario = replace(make_scenario(), communication_medium=CommunicationMediumSpec(failure_rate=2.0))
    with pytest.raises(ConfigError, match="failure_rate"):
        build_simulation(scenario)


def test_a_native_protocol_is_refused_with_its_node(make_scenario):
    pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")
    scenario = make_scenario("class Tested(Quiet): pass", "*.uavs[1].protocol.typename = BeaconProtocol")
    with pytest.raises(ConfigError) as error:
        build_simulation(scenario)
    assert error.value.key == "*.uavs[1].protocol.typename"


def test_each_assignment_with_its_time(make_scenario):
    count = vectors_of(run(make_scenario(COUNTER), vectors_of=[0]))["count"]
    assert list(count.times_ps)[:4] == [0, 70_000_000_000, 770_000_000_000, 1_470_000_000_000]
    assert list(count.values)[:4] == [0, 1, 2, 3]


def test_another_dictionary_ends_what_was_tracked(make_scenario):
    vectors = vectors_of(run(make_scenario(COUNTER), vectors_of=[0]))
    assert str(vectors["count"].values[-1]) == "nan"
    assert (list(vectors["finished"].times_ps), list(vectors["finished"].values)) == (
        [2_050_000_000_000],
        [1],
    )


def test_the_place_at_each_telemetry(make_scenario):
    vectors = vectors_of(run(make_scenario(FLYING), vectors_of=[0]))
    assert list(vectors["positionZ"].times_ps) == [500_000_000_000 * number for number in (1, 2, 3, 4)]
    assert [round(height, 6) for height in vectors["positionZ"].values] == [5, 10, 15, 20]
    assert set(vectors["positionX"].values) == {0}


def test_variables_that_the_protocol_took_when_it_was_made(make_scenario):
    result = run(make_scenario(EARLY), vectors_of=[0])
    vectors = vectors_of(result)
    assert (list(vectors["made"].times_ps), list(vectors["made"].values)) == ([0], [1])
    assert list(vectors["begun"].values) == [2, 3, 4, 5, 6]
    assert result.nodes[0].tracked_variables == {"made": 1, "begun": 6}


@pytest.mark.parametrize("python", ["class Tested(Talker): pass", EARLY], ids=["late", "early"])
def test_the_run_is_the_same(make_scenario, python):
    asked, unasked = (run(make_scenario(python), vectors_of=ids) for ids in ([0, 1], []))
    assert (asked.outcomes, asked.events) == (unasked.outcomes, unasked.events)
    assert [node.tracked_variables for node in asked.nodes] == [
        node.tracked_variables for node in unasked.nodes
    ]
