"""One autopilot in lock-step, here played by the test: what is said and answered by UDP."""

import struct
from contextlib import closing

import pytest

from gradysim.sitl.error import SitlError
from python.sitl.played_autopilot import IDLE, SERVOS, Played


@pytest.fixture
def played():
    with closing(Played()) as played:
        yield played


def test_the_answer_is_what_a_vehicle_on_the_ground_feels_after_a_step(played):
    played.ours.answer()
    assert played.felt() == {
        "timestamp": 1 / 400,
        "imu": {"gyro": [0, 0, 0], "accel_body": [0, 0, pytest.approx(-9.80665)]},
        "position": [0, 0, 0],
        "quaternion": [1, 0, 0, 0],
        "velocity": [0, 0, 0],
    }


def test_a_wish_that_is_repeated_is_taken_once(played):
    played.wish(1)
    assert not played.ours.take_wish()
    played.wish(2)
    assert played.ours.take_wish()


@pytest.mark.parametrize("data", [b"", b"hello", struct.pack(SERVOS, 1, 400, 2, *IDLE)])
def test_what_is_no_wish_is_ignored(played, data):
    played.physics.send(data)
    assert not played.ours.take_wish()


def test_its_motors_turn_the_vehicle(played):
    played.wish(2, pulses_us=[2000] * 16)
    assert played.ours.take_wish()
    for _ in range(40):
        played.ours.answer()
    assert played.ours.body.velocity_mps[2] < -1


def test_pulses_beyond_their_range_are_full_and_no_throttle(played):
    played.wish(2, pulses_us=[65535] * 16)
    played.ours.take_wish()
    played.ours.answer()
    full = played.ours.body.velocity_mps
    played.wish(3, pulses_us=[0] * 16)
    played.ours.take_wish()
    played.ours.answer()
    assert full[2] < 0
    assert played.ours.body.specific_force_mps2[2] == pytest.approx(0, abs=0.1)


def test_its_clock_is_a_multiple_of_its_steps_of_whatever_length(played):
    for _ in range(1000):
        played.ours.answer()
    assert played.ours.time_s == 2.5
    played.wish(2, rate_hz=1200)
    played.ours.take_wish()
    for _ in range(3):
        played.ours.answer()
    assert played.ours.time_s == 2.5 + 3 / 1200


def test_the_step_nearest_to_a_time_is_the_last_one(played):
    assert played.ours.is_behind(0.0013)
    assert not played.ours.is_behind(0.0012)


def test_an_end_of_the_connection_is_the_autopilots(played):
    played.mavlink.close()
    with pytest.raises(SitlError, match="vehicle 0: it died"):
        played.ours.listen()
    assert played.ours.link.lost == "it died"


def test_it_listens_only_to_what_is_there(played):
    assert not played.ours.listen()
    played.mavlink.sendall(b"\0")
    assert played.ours.listen()


def test_more_orders_than_it_takes_between_two_steps_end_it_instead_of_waiting_for_ever(played):
    def order(times):
        for _ in range(times):
            played.ours.link.send_bytes(bytes(100_000))

    with pytest.raises(SitlError, match="vehicle 0: it was given more orders than it can take"):
        order(1000)
