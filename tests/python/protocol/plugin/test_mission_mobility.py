import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.dispatcher import create_dispatcher
from gradysim.protocol.plugin.mission_mobility import (
    LoopMission,
    MissionMobilityConfiguration,
    MissionMobilityPlugin,
    MissionMobilityPluginException,
)
from python.quiet_protocol import Quiet

LINE = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (20.0, 0.0, 0.0)]


def mission(protocol, loop=LoopMission.NO, waypoints=LINE, **configuration):
    plugin = MissionMobilityPlugin(protocol, MissionMobilityConfiguration(loop_mission=loop, **configuration))
    plugin.start_mission(waypoints)
    return plugin


def arrive(protocol, plugin, waypoints=LINE):
    protocol.handle_telemetry(Telemetry(waypoints[plugin.current_waypoint]))


def visited(protocol, plugin, count, waypoints=LINE):
    """Return the indices of the waypoints flown to, if each one is reached in turn."""
    indices = []
    for _ in range(count):
        if plugin.is_idle:
            break
        indices.append(plugin.current_waypoint)
        arrive(protocol, plugin, waypoints)
    return indices


def test_a_new_plugin_is_idle(protocol):
    plugin = MissionMobilityPlugin(protocol)
    assert (plugin.is_idle, plugin.current_waypoint, plugin.is_reversed) == (True, None, False)


def test_the_defaults_are_the_published_ones():
    assert MissionMobilityConfiguration() == MissionMobilityConfiguration(
        speed=5, loop_mission=LoopMission.NO, tolerance=0.5
    )


def test_starting_goes_to_the_first_waypoint(protocol):
    plugin = mission(protocol)
    assert protocol.provider.targets == [LINE[0]]
    assert (plugin.is_idle, plugin.current_waypoint) == (False, 0)


def test_speed_and_tolerance_may_be_nothing(protocol):
    plugin = mission(protocol, speed=0, tolerance=0)
    arrive(protocol, plugin)
    assert (protocol.provider.speeds, plugin.current_waypoint) == ([0], 1)


def test_starting_sets_the_speed(protocol):
    mission(protocol, speed=7)
    assert protocol.provider.speeds == [7]


def test_a_mission_without_loop_ends_at_its_last_waypoint(protocol):
    plugin = mission(protocol)
    assert visited(protocol, plugin, 10) == [0, 1, 2]
    assert (plugin.is_idle, plugin.current_waypoint) == (True, None)


def test_restart_goes_from_the_last_to_the_first(protocol):
    assert visited(protocol, mission(protocol, LoopMission.RESTART), 7) == [0, 1, 2, 0, 1, 2, 0]


def test_reverse_turns_round_at_both_ends_alike(protocol):
    assert visited(protocol, mission(protocol, LoopMission.REVERSE), 9) == [0, 1, 2, 1, 0, 1, 2, 1, 0]


def test_every_waypoint_is_a_command(protocol):
    visited(protocol, mission(protocol, LoopMission.REVERSE), 4)
    assert protocol.provider.targets == [LINE[index] for index in (0, 1, 2, 1, 0)]


@pytest.mark.parametrize("loop", [LoopMission.RESTART, LoopMission.REVERSE])
def test_a_loop_of_one_waypoint_stays_there_in_silence(protocol, loop):
    plugin = mission(protocol, loop, waypoints=[(5.0, 5.0, 5.0)])
    assert visited(protocol, plugin, 3, [(5.0, 5.0, 5.0)]) == [0, 0, 0]
    assert protocol.provider.targets == [(5.0, 5.0, 5.0)]


@pytest.mark.parametrize("tolerance", [0.5, 4])
@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize(("share", "waypoint"), [(1, 1), (-1, 1), (1.02, 0), (-1.02, 0)])
def test_a_waypoint_is_reached_within_the_tolerance(protocol, tolerance, axis, share, waypoint):
    plugin = mission(protocol, tolerance=tolerance)
    position = [0.0, 0.0, 0.0]
    position[axis] = share * tolerance
    protocol.handle_telemetry(Telemetry(tuple(position)))
    assert plugin.current_waypoint == waypoint


def test_the_protocol_still_gets_its_telemetry(protocol):
    mission(protocol)
    telemetry = Telemetry(LINE[0])
    protocol.handle_telemetry(telemetry)
    assert protocol.calls == [("handle_telemetry", telemetry)]


def test_stopping_sends_no_command(protocol):
    plugin = mission(protocol)
    before = len(protocol.provider.commands)
    plugin.stop_mission()
    assert len(protocol.provider.commands) == before
    assert plugin.is_idle


def test_a_stopped_mission_does_not_go_on(protocol):
    plugin = mission(protocol)
    plugin.stop_mission()
    protocol.handle_telemetry(Telemetry(LINE[0]))
    assert protocol.provider.targets == [LINE[0]]


def test_a_stopped_mission_is_not_reversed_any_more(protocol):
    plugin = mission(protocol, LoopMission.REVERSE)
    plugin.set_reversed(True)
    plugin.stop_mission()
    assert not plugin.is_reversed


def test_after_a_stop_a_mission_is_flown_once_not_twice(protocol):
    near = [(0, 0, 0), (0.1, 0, 0), (0.2, 0, 0), (9, 0, 0)]
    plugin = mission(protocol, waypoints=near)
    plugin.stop_mission()
    plugin.start_mission(near)
    protocol.handle_telemetry(Telemetry((0, 0, 0)))
    assert plugin.current_waypoint == 1


def test_stopping_when_idle_does_nothing(protocol):
    plugin = MissionMobilityPlugin(protocol)
    plugin.stop_mission()
    assert plugin.is_idle


def test_a_mission_stopped_by_an_earlier_handler_sends_nothing_for_that_telemetry(protocol):
    plugin = mission(protocol)
    create_dispatcher(protocol).register_handle_telemetry(lambda _protocol, _telemetry: plugin.stop_mission())
    protocol.handle_telemetry(Telemetry(LINE[0]))
    assert protocol.provider.targets == [LINE[0]]


def test_a_second_mission_replaces_the_first(protocol):
    plugin = mission(protocol, LoopMission.REVERSE)
    visited(protocol, plugin, 3)
    plugin.start_mission([(1, 1, 1), (2, 2, 2)])
    assert (plugin.current_waypoint, plugin.is_reversed) == (0, False)
    protocol.handle_telemetry(Telemetry((1.0, 1.0, 1.0)))
    assert protocol.provider.targets[-2:] == [(1, 1, 1), (2, 2, 2)]


def test_setting_the_waypoint_goes_there(protocol):
    plugin = mission(protocol)
    plugin.set_current_waypoint(2)
    assert (plugin.current_waypoint, protocol.provider.targets[-1]) == (2, LINE[2])


@pytest.mark.parametrize("waypoint", [-1, 3, 1.0, True, None])
def test_a_waypoint_that_does_not_exist_is_refused(protocol, waypoint):
    plugin = mission(protocol)
    with pytest.raises(MissionMobilityPluginException):
        plugin.set_current_waypoint(waypoint)


def test_turning_round_goes_to_the_waypoint_before(protocol):
    plugin = mission(protocol, LoopMission.REVERSE)
    visited(protocol, plugin, 2)
    plugin.set_reversed(True)
    assert (plugin.is_reversed, plugin.current_waypoint, protocol.provider.targets[-1]) == (True, 1, LINE[1])


def test_turning_back_goes_to_the_waypoint_after(protocol):
    plugin = mission(protocol, LoopMission.REVERSE)
    visited(protocol, plugin, 3)
    plugin.set_reversed(False)
    assert (plugin.is_reversed, plugin.current_waypoint) == (False, 2)


def test_turning_into_the_present_direction_does_nothing(protocol):
    plugin = mission(protocol, LoopMission.REVERSE)
    before = len(protocol.provider.commands)
    plugin.set_reversed(False)
    assert len(protocol.provider.commands) == before


def test_turning_round_at_the_end_stays_in_the_mission(protocol):
    plugin = mission(protocol, LoopMission.REVERSE)
    plugin.set_reversed(True)
    assert visited(protocol, plugin, 3) == [0, 1, 2]


@pytest.mark.parametrize("loop", [LoopMission.NO, LoopMission.RESTART])
def test_only_a_reversing_mission_turns_round(protocol, loop):
    plugin = mission(protocol, loop)
    with pytest.raises(MissionMobilityPluginException, match=f"REVERSE.*{loop.name}"):
        plugin.set_reversed(True)


def test_orders_without_a_mission_are_refused(protocol):
    plugin = MissionMobilityPlugin(protocol, MissionMobilityConfiguration(loop_mission=LoopMission.REVERSE))
    with pytest.raises(MissionMobilityPluginException):
        plugin.set_current_waypoint(0)
    with pytest.raises(MissionMobilityPluginException):
        plugin.set_reversed(True)


def test_an_empty_mission_is_refused(protocol):
    with pytest.raises(MissionMobilityPluginException):
        mission(protocol, waypoints=[])


@pytest.mark.parametrize("waypoint", [(1, 2), (1, 2, 3, 4), (1, 2, math.nan), ("a", 2, 3), None, 5])
def test_a_malformed_waypoint_is_refused(protocol, waypoint):
    with pytest.raises(MissionMobilityPluginException, match="waypoint 1"):
        mission(protocol, waypoints=[(0, 0, 0), waypoint])


@pytest.mark.parametrize(
    "wrong",
    [
        {"speed": -1},
        {"speed": math.nan},
        {"speed": "fast"},
        {"tolerance": -0.1},
        {"tolerance": None},
        {"loop_mission": "REVERSE"},
    ],
)
def test_a_wrong_configuration_is_refused(protocol, wrong):
    with pytest.raises(MissionMobilityPluginException, match=next(iter(wrong))):
        MissionMobilityPlugin(protocol, MissionMobilityConfiguration(**wrong))


def test_a_mission_from_a_file(protocol, tmp_path):
    path = tmp_path / "mission.txt"
    path.write_text("0,0,0\n1.5, 2, -3\n\n")
    plugin = MissionMobilityPlugin(protocol)
    plugin.start_mission_with_waypoint_file(str(path))
    assert visited(protocol, plugin, 5, [(0, 0, 0), (1.5, 2, -3)]) == [0, 1]


def test_a_mission_file_may_start_with_a_byte_order_mark(protocol, tmp_path):
    path = tmp_path / "mission.txt"
    path.write_text("0,0,0\n", encoding="utf-8-sig")
    MissionMobilityPlugin(protocol).start_mission_with_waypoint_file(path)
    assert protocol.provider.targets == [(0, 0, 0)]


@pytest.mark.parametrize("line", ["1,2", "1,2,3,4", "a,b,c", "1 2 3", "1,nan,3", "1,2,inf"])
def test_a_malformed_file_is_refused_with_its_line(protocol, tmp_path, line):
    path = tmp_path / "mission.txt"
    path.write_text(f"0,0,0\n{line}\n")
    with pytest.raises(MissionMobilityPluginException, match=r"mission\.txt:2: .*x,y,z"):
        MissionMobilityPlugin(protocol).start_mission_with_waypoint_file(str(path))


def test_a_missing_file_is_refused_with_the_place_where_it_was_looked_for(protocol, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(MissionMobilityPluginException, match=re.escape(f" {tmp_path}/nowhere.txt: ")):
        MissionMobilityPlugin(protocol).start_mission_with_waypoint_file("nowhere.txt")


def test_an_empty_file_is_refused(protocol, tmp_path):
    path = tmp_path / "mission.txt"
    path.write_text("\n")
    with pytest.raises(MissionMobilityPluginException, match=r"mission\.txt: "):
        MissionMobilityPlugin(protocol).start_mission_with_waypoint_file(str(path))


FLIGHT = """
from gradysim.protocol.plugin.mission_mobility import (
    LoopMission, MissionMobilityConfiguration, MissionMobilityPlugin
)

class Pilot(Quiet):
    def initialize(self):
        self.reached = []
        self.plugin = MissionMobilityPlugin(self, MissionMobilityConfiguration(20, LoopMission.REVERSE))
        self.plugin.start_mission([(20, 0, 0), (20, 20, 0), (20, 20, 20)])

    def handle_telemetry(self, telemetry):
        waypoint = self.plugin.current_waypoint
        if self.reached[-1:] != [waypoint]:
            self.reached.append(waypoint)

    def finish(self):
        self.provider.tracked_variables["waypoints"] = self.reached
"""


def test_a_mission_in_a_simulation(make_scenario, run_mode):
    (pilot,) = run_mode(
        make_scenario(FLIGHT, "sim-time-limit = 5.5s", '*.uav.protocol.class = "protocols.py:Pilot"')
    )
    assert pilot.tracked_variables["waypoints"] == [0, 1, 2, 1, 0, 1]


@given(
    st.integers(1, 6),
    st.sampled_from(LoopMission),
    st.lists(st.sampled_from(["arrive", "turn", "jump"]), max_size=30),
)
def test_whatever_happens_the_waypoint_is_one_of_the_mission(length, loop, steps):
    class Provider:
        target = None

        def send_mobility_command(self, command):
            if command.command_type == 1:
                self.target = (command.param_1, command.param_2, command.param_3)

    protocol = Quiet.instantiate(Provider())
    waypoints = [(float(10 * index), 0.0, 0.0) for index in range(length)]
    plugin = mission(protocol, loop, waypoints)
    for step in steps:
        if plugin.is_idle:
            break
        if step == "arrive":
            arrive(protocol, plugin, waypoints)
        elif step == "turn" and loop is LoopMission.REVERSE:
            plugin.set_reversed(not plugin.is_reversed)
        elif step == "jump":
            plugin.set_current_waypoint(length - 1)
        if not plugin.is_idle:
            assert 0 <= plugin.current_waypoint < length
            assert protocol.provider.target == waypoints[plugin.current_waypoint]
    assert plugin.is_idle is False or loop is LoopMission.NO
