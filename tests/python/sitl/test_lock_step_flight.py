"""One node on simulated time."""

import json
from contextlib import ExitStack

import pytest

from gradysim.sitl.dialect import load_dialect
from gradysim.sitl.fleet import Fleet
from gradysim.sitl.lock_step_flight import LockStepFlight
from python.sitl.on_simulated_time import REFERENCE, nodes

pytestmark = pytest.mark.usefixtures("own_folder")

mavlink = load_dialect()


@pytest.fixture
def flight_from():
    """`flight_from(start, ...)`: one that is not started, and closed after the test."""
    with ExitStack() as ends:

        def make(start, program=None, on_text=None, **settings):
            (node,) = nodes(program, start, **settings)
            flight = LockStepFlight(node, REFERENCE, on_text)
            ends.callback(flight.autopilot.close)
            return flight

        yield make


def test_x_and_y_count_from_the_origin_and_heights_from_the_ground(flight_from):
    """The vehicle takes off below its start, and its physics count from there."""
    flight = flight_from((100.0, 200.0, 30.0))
    flight.autopilot.body.position_m = (1.0, -2.0, -5.0)
    assert flight.position == (101.0, 198.0, 5.0)


@pytest.mark.parametrize(
    ("position_m", "velocity_mps", "is_settled"),
    [
        ((0.0, 0.0, -10.0), (0.0, 0.0, 0.0), True),
        ((0.1, 0.1, -10.1), (0.05, 0.0, 0.05), True),
        ((0.0, 0.0, -9.7), (0.0, 0.0, 0.0), False),
        ((0.0, 0.0, -10.0), (0.0, 0.15, 0.0), False),
        ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), False),
    ],
)
def test_it_has_settled_when_it_is_at_its_start_and_stays_there(
    flight_from, position_m, velocity_mps, is_settled
):
    flight = flight_from((50.0, 0.0, 10.0))
    flight.autopilot.body.position_m, flight.autopilot.body.velocity_mps = position_m, velocity_mps
    assert flight.is_settled == is_settled


def test_its_autopilot_is_told_what_it_flies_and_how_warm_it_is_and_what_is_wished_wins(
    toy_copter, flight_from
):
    program = toy_copter()
    flight = flight_from((0.0, 0.0, 10.0), program, parameters={"MOT_THST_EXPO": 0.25, "BATT_MONITOR": 0.0})
    fleet = Fleet(program, user=None)
    flight.start(fleet, 20.0)
    fleet.close()
    parameters = json.loads(program.with_name("final_0.json").read_text())["parameters"]
    assert (parameters["SIM_RATE_HZ"], parameters["GND_TEMP"]) == (400, 8.5)
    assert (parameters["MOT_THST_EXPO"], parameters["BATT_MONITOR"]) == (0.25, 0)


def test_what_its_autopilot_says_is_told_with_its_name(flight_from):
    told = []
    flight = flight_from((0.0, 0.0, 10.0), on_text=lambda *said: told.append(said))
    codec = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    for message in (
        mavlink.MAVLink_heartbeat_message(2, 3, 1, 4, 4, 3),
        mavlink.MAVLink_statustext_message(2, b"PreArm: no"),
    ):
        flight.autopilot.link.feed(message.pack(codec))
    assert told == [("vehicle 0", "PreArm: no")]


def test_the_wind_of_the_parameters_blows(toy_copter, flights_of):
    """The toy does not know of it, and is off by what its gains leave."""
    parameters = {"SIM_WIND_SPD": 1.0, "SIM_WIND_DIR": 90.0}
    flights = flights_of(toy_copter(), (0.0, 0.0, 10.0), parameters=parameters)
    north, east, _ = flights.position(0)
    assert abs(north) < 0.02
    assert east < -0.05
