"""Without `real_time` the autopilots fly on simulated time."""

import asyncio
import csv
import logging

import pytest

from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetSpeedMobilityCommand
from gradysim.simulator.handler.ardupilot_mobility import ArdupilotMobilityException
from python.sitl.ardupilot_mobility.flying import (
    Flyer,
    build,
    failure_of,
    flyer,
    near,
)
from python.sitl.ardupilot_mobility.flying import fly as fly_at_any_pace


def fly(*arguments, **settings):
    return fly_at_any_pace(*arguments, real_time=False, **settings)


def test_every_node_is_in_the_air_at_its_place_when_the_simulation_starts(toy_copter):
    simulator = build(toy_copter(), Flyer, Flyer, positions=[(0, 0, 10), (30, -20, 15)], real_time=False)
    simulator.step_simulation()
    assert [node.position for node in simulator.nodes] == [
        near((0, 0, 10), 0.3),
        near((30, -20, 15), 0.3),
    ]


def test_telemetry_comes_at_each_update_without_a_drop(toy_copter, tmp_path):
    (protocol,) = fly(toy_copter(), Flyer, duration=5, update_rate=0.25)
    assert [moment for moment, _ in protocol.telemetry] == [0.25 * number for number in range(1, 21)]
    with (tmp_path / "ardupilot_mobility_report.csv").open() as file:
        (row,) = csv.DictReader(file)
    assert (row["telemetry_requests"], row["telemetry_drops"]) == ("20", "0")
    assert 0 <= float(row["battery_wasted"]) <= 2


def test_commands_are_obeyed(toy_copter):
    tested = flyer(at_1=GotoCoordsMobilityCommand(60, -20, 18), at_0=SetSpeedMobilityCommand(8))
    (protocol,) = fly(toy_copter(), tested, duration=15, positions=[(0, 0, 10)])
    assert protocol.at(1) == near((0, 0, 10), 0.3)
    assert protocol.at(15) == near((60, -20, 18))
    assert protocol.at(6)[0] - protocol.at(5)[0] == pytest.approx(8 * 60 / 64, abs=0.8)


def test_two_simulations_are_the_same_to_the_last_bit(toy_copter):
    tested = flyer(at_1=GotoCoordsMobilityCommand(60, -20, 18))
    tracks = [[each.telemetry for each in fly(toy_copter(), tested, Flyer, duration=3)] for _ in range(2)]
    assert tracks[0] == tracks[1]


@pytest.mark.parametrize("real_time", [False, 10])
def test_it_flies_in_a_notebook_too(toy_copter, real_time):
    """Another asyncio loop runs in the same thread."""

    async def cell():
        return fly_at_any_pace(toy_copter(), Flyer, duration=0.5, real_time=real_time)

    (protocol,) = asyncio.run(cell())
    assert len(protocol.telemetry) >= 4


def test_what_autopilots_say_can_be_logged(toy_copter, caplog):
    caplog.set_level(logging.INFO)
    program = toy_copter({0: {"refuse_arming": True}})
    failure_of(program, Flyer, uav_api_log_console=True, uav_api_startup_timeout=2, real_time=False)
    assert any("(Flyer 0)" in message and "PreArm: " in message for message in caplog.messages)


def test_an_autopilot_that_dies_ends_the_simulation(toy_copter):
    said = failure_of(toy_copter({0: {"dies_at": 10}}), Flyer, duration=20, real_time=False)
    assert said.startswith("node 0 (Flyer 0): ")
    assert "status 7" in said


def test_a_command_that_means_nothing_is_refused(toy_copter):
    tested = flyer(at_0=SetSpeedMobilityCommand(-1))
    said = failure_of(toy_copter(), tested, real_time=False)
    assert said.startswith("node 0 ")
    assert "speed -1" in said


def test_a_command_before_take_off_is_refused(toy_copter):
    simulator = build(toy_copter(), Flyer, real_time=False)
    (node,) = simulator.nodes
    handler = node.protocol_encapsulator.provider.handlers["mobility"]
    with pytest.raises(ArdupilotMobilityException, match="take-off"):
        handler.handle_command(GotoCoordsMobilityCommand(0, 0, 10), node)
