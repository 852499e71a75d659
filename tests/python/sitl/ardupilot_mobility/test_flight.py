"""Flights of nodes, from take-off on."""

import json
import math

from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.protocol.position import geo_to_cartesian
from python.sitl.ardupilot_mobility.flying import REFERENCE, Flyer, fly, flyer, near


def test_every_node_is_in_the_air_at_its_place_when_the_simulation_starts(toy_copter):
    places = [(0, 0, 10), (30, -20, 15), (5, 5, 0)]
    for protocol, place in zip(
        fly(toy_copter(), *([Flyer] * 3), positions=places, duration=1), places, strict=True
    ):
        assert protocol.telemetry[0][0] == 0
        assert protocol.telemetry[0][1] == near(place)


def test_telemetry_comes_at_most_once_in_each_update(toy_copter):
    (protocol,) = fly(toy_copter(), Flyer, duration=5, update_rate=0.5)
    updates = [math.floor(moment / 0.5) for moment, _ in protocol.telemetry]
    assert updates == sorted(set(updates))
    assert len(updates) > 5


def test_x_is_north_and_y_is_east(toy_copter):
    (protocol,) = fly(toy_copter(), flyer(at_1=GotoCoordsMobilityCommand(60, -20, 18)), duration=12)
    assert protocol.at(12) == near((60, -20, 18))


def test_a_geographic_place_is_the_one_that_the_frame_gives_it(toy_copter):
    place = (-15.8395, -47.9197, 1020.0)
    (protocol,) = fly(toy_copter(), flyer(at_1=GotoGeoCoordsMobilityCommand(*place)), duration=12)
    assert protocol.at(12) == near(geo_to_cartesian(REFERENCE, place))


def test_without_reference_coordinates_nodes_fly_at_latitude_and_longitude_0(toy_copter):
    (protocol,) = fly(
        toy_copter(),
        flyer(at_1=GotoCoordsMobilityCommand(20, 0, 10), at_5=GotoCoordsMobilityCommand(0, 0, 10)),
        positions=[(0, 0, 10)],
        reference_coordinates=(0, 0, 0),
        duration=9,
    )
    assert (protocol.at(4.9), protocol.at(9)) == (near((20, 0, 10)), near((0, 0, 10)))


def final_state(program, identifier=0):
    """Return the final state of the autopilot: target (north, east, up of its home), speed, velocity."""
    state = json.loads(program.with_name(f"final_{identifier}.json").read_text())
    assert state.pop("greetings") == 0, "ArduPilot takes a ground station that was there once for lost"
    state.pop("parameters")
    return state


def test_the_default_speed_is_set(toy_copter):
    program = toy_copter()
    fly(program, flyer(at_0=GotoCoordsMobilityCommand(300, 5, 12)), duration=1, default_speed=7)
    assert final_state(program) == {"target": near([300, 0, 12], 0.1), "speed": 7, "velocity": None}


def test_a_speed_is_obeyed(toy_copter):
    tested = flyer(at_0=GotoCoordsMobilityCommand(300, 5, 12), at_1=SetSpeedMobilityCommand(20))
    program = toy_copter()
    fly(program, tested)
    assert final_state(program)["speed"] == 20


def test_at_speed_0_it_stands(toy_copter):
    tested = flyer(at_0=GotoCoordsMobilityCommand(300, 5, 12), at_1=SetSpeedMobilityCommand(0))
    program = toy_copter()
    fly(program, tested)
    assert final_state(program)["target"] is None


def test_after_speed_0_it_goes_on_with_the_next_speed(toy_copter):
    tested = flyer(
        at_0=SetSpeedMobilityCommand(0),
        at_1=GotoCoordsMobilityCommand(300, 5, 12),
        at_2=SetSpeedMobilityCommand(8),
    )
    program = toy_copter()
    fly(program, tested)
    assert final_state(program) == {"target": near([300, 0, 12], 0.1), "speed": 8, "velocity": None}


def test_a_velocity_is_held_until_told_otherwise(toy_copter):
    program = toy_copter()
    fly(program, flyer(at_0=SetVelocityMobilityCommand(3, -4, 1)), duration=10, real_time=8)
    assert final_state(program)["velocity"] == [3, -4, 1]


def test_after_a_velocity_the_speed_set_before_holds_again(toy_copter):
    tested = flyer(
        at_0=SetSpeedMobilityCommand(12),
        at_1=SetVelocityMobilityCommand(3, -4, 1),
        at_2=GotoCoordsMobilityCommand(300, 5, 12),
    )
    program = toy_copter()
    fly(program, tested)
    assert final_state(program) == {"target": near([300, 0, 12], 0.1), "speed": 12, "velocity": None}


def test_the_newest_target_counts(toy_copter):
    tested = flyer(
        at_1=GotoCoordsMobilityCommand(-500, 0, 12),
        **{"at_1.5": GotoCoordsMobilityCommand(20, 5, 12)},
    )
    (protocol,) = fly(toy_copter(), tested, duration=8)
    assert protocol.at(8) == near((20, 5, 12))


def test_an_autopilot_of_the_old_kind_flies_too(toy_copter):
    tested = flyer(at_1=GotoCoordsMobilityCommand(20, 5, 12))
    (protocol,) = fly(toy_copter({0: {"old": True}}), tested, duration=6)
    assert protocol.at(6) == near((20, 5, 12))


def test_commands_whose_answer_is_lost_are_repeated(toy_copter, quick_answers):
    (protocol,) = fly(toy_copter({0: {"loses_first": True}}), Flyer, duration=1)
    assert protocol.telemetry
