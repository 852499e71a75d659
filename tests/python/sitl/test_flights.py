"""Vehicles on simulated time; the toy replaces ArduCopter."""

import gc
import json
from contextlib import ExitStack

import pytest

from gradysim.sitl import SitlError
from gradysim.sitl.fleet import Fleet
from gradysim.sitl.flights import Flights, LockStepFlight
from gradysim.sitl.mavlink import load_dialect
from python.sitl.on_simulated_time import REFERENCE, failure_of, flown, nodes

pytestmark = pytest.mark.usefixtures("own_folder")


def test_all_hover_at_their_starts_when_they_begin(toy_copter, flights_of):
    starts = [(0.0, 0.0, 10.0), (30.0, -20.0, 15.0), (5.0, 5.0, 3.0)]
    flights = flights_of(toy_copter(), *starts)
    for number, start in enumerate(starts):
        assert flights.position(number) == pytest.approx(start, abs=0.3)
    assert list(flights.ids) == [0, 1, 2]


def test_one_flies_where_it_is_sent_and_the_other_stays(toy_copter, flights_of):
    flights = flights_of(toy_copter(), (0.0, 0.0, 10.0), (0.0, 20.0, 10.0))
    flights.pilot(0).go_to((60.0, -20.0, 18.0))
    flown(flights, 20)
    assert flights.position(0) == pytest.approx((60, -20, 18), abs=0.5)
    assert flights.position(1) == pytest.approx((0, 20, 10), abs=0.5)


def test_a_speed_is_flown(toy_copter, flights_of):
    flights = flights_of(toy_copter(), (0.0, 0.0, 10.0))
    flights.pilot(0).go_to((500.0, 0.0, 10.0))
    flights.pilot(0).set_speed(4.0)
    track = flown(flights, 12)
    assert track[-1][0] - track[-201][0] == pytest.approx(8, abs=0.4)


def test_a_velocity_is_held(toy_copter, flights_of):
    flights = flights_of(toy_copter(), (0.0, 0.0, 10.0))
    flights.pilot(0).set_velocity((0.0, 3.0, 1.0))
    track = flown(flights, 12)
    moved = [b - a for a, b in zip(track[-201], track[-1], strict=True)]
    assert moved == pytest.approx([0, 6, 2], abs=0.4)


@pytest.mark.parametrize("height_m", [0.0, -5.0])
def test_one_lands_where_it_is_sent_stands_there_and_flies_on(toy_copter, flights_of, height_m):
    flights = flights_of(toy_copter(), (0.0, 0.0, 5.0))
    flights.pilot(0).go_to((10.0, -5.0, height_m))
    track = flown(flights, 20)
    assert track[-1] == pytest.approx((10, -5, 0), abs=0.5)
    assert track[-200:] == [track[-1]] * 200
    flights.pilot(0).go_to((10.0, 5.0, 4.0))
    assert flown(flights, 20, begin=20.0)[-1] == pytest.approx((10, 5, 4), abs=0.5)


def test_who_has_landed_by_a_velocity_obeys_a_target_in_the_air(toy_copter, flights_of):
    flights = flights_of(toy_copter(), (0.0, 0.0, 5.0))
    flights.pilot(0).set_velocity((0.0, 0.0, -1.0))
    assert flown(flights, 10)[-1][2] == 0
    flights.pilot(0).go_to((10.0, 0.0, 5.0))
    assert flown(flights, 15, begin=10.0)[-1] == pytest.approx((10, 0, 5), abs=0.5)


def test_two_flights_are_the_same_to_the_last_bit(toy_copter, flights_of):
    def flight():
        flights = flights_of(toy_copter(), (0.0, 0.0, 10.0), (0.0, 20.0, 10.0))
        flights.pilot(0).go_to((40.0, 10.0, 15.0))
        track = flown(flights, 2)
        flights.pilot(0).set_speed(7.0)
        return [*track, *flown(flights, 3, begin=2.0)]

    assert flight() == flight()


def test_how_often_it_is_asked_where_they_are_makes_no_difference(toy_copter, flights_of):
    def flight(step):
        flights = flights_of(toy_copter(), (0.0, 0.0, 10.0))
        flights.pilot(0).go_to((40.0, 10.0, 15.0))
        return flown(flights, 3, step=step)[-1]

    assert flight(0.01) == flight(0.5)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (
            {"refuse_arming": True},
            'vehicle 0: arming: refused with MAV_RESULT_FAILED; the autopilot said: "PreArm',
        ),
        ({"no_fix": True}, "vehicle 0: position estimate: not done after 3 s"),
        ({"deaf": True}, "vehicle 0: telemetry: no answer after 5 tries"),
        (
            {"dies_at": "take-off"},
            "vehicle 0: the autopilot ended with status 7; it printed last: the battery",
        ),
        (
            {"dies_at": 2},
            "vehicle 0: the autopilot ended with status 7; it printed last: the battery exploded",
        ),
        ({"leaves_at": 2}, "vehicle 0: flight: it left mode GUIDED for mode number 9"),
        (
            {"exits": True},
            "ended with status 3; it printed last: no such model; is it ArduCopter 4.1 or newer?",
        ),
    ],
)
def test_what_goes_wrong_is_told(toy_copter, flights_of, wrong, said):
    assert said in failure_of(flights_of, toy_copter({0: wrong}), timeout_s=3.0)


def test_one_that_starts_and_does_nothing_is_given_up(toy_copter, flights_of):
    said = failure_of(flights_of, toy_copter({0: {"gives_up": True}}), timeout_s=1.0)
    assert said.startswith("vehicle 0: ")
    assert said.endswith(" param")


def test_a_start_below_the_ground_is_refused_before_take_off(toy_copter):
    flights = Flights(nodes(toy_copter(), (0.0, 0.0, -5.0)), REFERENCE)
    with pytest.raises(SitlError, match=r"vehicle 0: .*z = -5 m"):
        flights.begin()
    flights.close()


def test_those_that_do_not_begin_are_ended(toy_copter, tmp_path):
    program = toy_copter({1: {"refuse_arming": True}})
    flights = Flights(nodes(program, (0.0, 0.0, 10.0), (0.0, 9.0, 10.0)), REFERENCE, timeout_s=2.0)
    with pytest.raises(SitlError, match=r"vehicle 1: .*MAV_RESULT_FAILED"):
        flights.begin()
    assert list(tmp_path.glob("gradysim-sitl-*")) == []


def test_nothing_is_left_of_them(toy_copter, flights_of, tmp_path, caplog):
    flights = flights_of(toy_copter(), (0.0, 0.0, 10.0))
    flights.close()
    flights.close()
    gc.collect()
    assert list(tmp_path.glob("gradysim-sitl-*")) == []
    assert caplog.records == []


def test_of_several_failures_one_is_told_and_the_others_are_not_logged(toy_copter, caplog):
    program = toy_copter({number: {"refuse_arming": True} for number in range(2)})
    flights = Flights(nodes(program, (0.0, 0.0, 10.0), (0.0, 9.0, 10.0)), REFERENCE, timeout_s=2.0)
    with pytest.raises(SitlError, match=r"vehicle 0: .*MAV_RESULT_FAILED"):
        flights.begin()
    flights.close()
    del flights
    gc.collect()
    assert caplog.records == []


def test_a_speed_leaves_before_the_next_step(toy_copter, flights_of):
    flights = flights_of(toy_copter(), (0.0, 0.0, 10.0))
    flown(flights, 1)
    sent = []
    link = flights.pilot(0).vehicle.link
    send_bytes, link.send_bytes = link.send_bytes, lambda data: (sent.append(data), send_bytes(data))
    flights.pilot(0).set_speed(4.0)
    flights.advance_to(1.0001)
    assert len(sent) == 1


pytestmark = pytest.mark.usefixtures("own_folder")

mavlink = load_dialect()


@pytest.fixture
def flight_from():
    """`flight_from(start, ...)`: a flight that is not started, and closed after the test."""
    with ExitStack() as ends:

        def make(start, program=None, on_text=None, **settings):
            (node,) = nodes(program, start, **settings)
            flight = LockStepFlight(node, REFERENCE, on_text)
            ends.callback(flight.autopilot.close)
            return flight

        yield make


def test_x_and_y_count_from_the_origin_and_heights_from_the_ground(flight_from):
    """The vehicle takes off below its start, which is the origin of its physics."""
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
    """The toy does not model wind, and its control has a steady error."""
    parameters = {"SIM_WIND_SPD": 1.0, "SIM_WIND_DIR": 90.0}
    flights = flights_of(toy_copter(), (0.0, 0.0, 10.0), parameters=parameters)
    north, east, _ = flights.position(0)
    assert abs(north) < 0.02
    assert east < -0.05
