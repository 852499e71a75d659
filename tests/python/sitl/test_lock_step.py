"""One autopilot in lock-step, played by the test: its messages by UDP, and the answers."""

import asyncio
import gc
import math
import socket
import struct
import time
from contextlib import ExitStack, closing

import pytest

from gradysim.motion.wind import Wind, WindAtVehicle
from gradysim.sitl import SitlError
from gradysim.sitl.flights import Flights
from gradysim.sitl.lock_step import LockStepGroup, VehicleClockLoop
from python.sitl.on_simulated_time import REFERENCE, failure_of, flown, nodes
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
    assert not played.ours.take_servos()
    played.wish(2)
    assert played.ours.take_servos()


@pytest.mark.parametrize("data", [b"", b"hello", struct.pack(SERVOS, 1, 400, 2, *IDLE)])
def test_what_is_no_wish_is_ignored(played, data):
    played.physics.send(data)
    assert not played.ours.take_servos()


def test_a_wish_of_somebody_else_is_ignored_and_counted(played, caplog):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        for frame in (2, 3):
            other.sendto(struct.pack(SERVOS, 18458, 400, frame, *IDLE), ("127.0.0.1", played.ours.port))
    with closing(LockStepGroup([played.ours])) as group:
        assert not group.fly_to(0.0)
    assert not played.ours.take_servos()
    assert played.ours.foreign_datagrams == 2
    played.ours.close()
    assert "2 datagrams" in caplog.text


def test_the_wind_of_the_scenario_moves_the_vehicle():
    wind = WindAtVehicle(Wind(6.0, math.pi / 2, 1.0), 1, 0)
    with closing(Played(wind=wind)) as played:
        played.ours.body.position_m = (0.0, 0.0, -50.0)
        for _ in range(400):
            played.ours.answer()
        north, east, _ = played.ours.body.velocity_mps
        assert east > 0.5 > abs(north)
        assert played.ours.body.wind_mps != (0, 6, 0)


def test_its_motors_turn_the_vehicle(played):
    played.wish(2, pulses_us=[2000] * 16)
    assert played.ours.take_servos()
    for _ in range(40):
        played.ours.answer()
    assert played.ours.body.velocity_mps[2] < -1


def test_pulses_beyond_their_range_are_full_and_no_throttle(played):
    played.wish(2, pulses_us=[65535] * 16)
    played.ours.take_servos()
    played.ours.answer()
    full = played.ours.body.velocity_mps
    played.wish(3, pulses_us=[0] * 16)
    played.ours.take_servos()
    played.ours.answer()
    assert full[2] < 0
    assert played.ours.body.specific_force_mps2[2] == pytest.approx(0, abs=0.1)


def test_its_clock_is_a_multiple_of_its_steps_of_whatever_length(played):
    for _ in range(1000):
        played.ours.answer()
    assert played.ours.time_s == 2.5
    played.wish(2, rate_hz=1200)
    played.ours.take_servos()
    for _ in range(3):
        played.ours.answer()
    assert played.ours.time_s == 2.5 + 3 / 1200


def test_the_step_nearest_to_a_time_is_the_last_one(played):
    assert played.ours.is_behind(0.0013)
    assert not played.ours.is_behind(0.0012)


def test_an_end_of_the_connection_is_the_autopilots(played):
    played.mavlink.close()
    with pytest.raises(SitlError, match=r"vehicle 0: .*died"):
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

    with pytest.raises(SitlError, match="vehicle 0: "):
        order(1000)


pytestmark = pytest.mark.usefixtures("own_folder")


@pytest.fixture
def group_of():
    """`group_of(played, ...)`: a group of these autopilots."""
    with ExitStack() as ends:

        def make(*played):
            group = LockStepGroup([ends.enter_context(closing(each)).ours for each in played])
            ends.callback(group.close)
            return group

        yield make


def test_each_takes_its_own_steps_to_the_same_time(group_of):
    coarse, fine = Played(rate_hz=400), Played(rate_hz=1200)
    group = group_of(coarse, fine)
    for frame in range(2, 4):
        coarse.wish(frame, 400)
    for frame in range(2, 8):
        fine.wish(frame, 1200)
    group.fly_to(0.005)
    assert [coarse.felt()["timestamp"] for _ in range(2)] == [1 / 400, 2 / 400]
    assert [fine.felt()["timestamp"] for _ in range(6)] == [number / 1200 for number in range(1, 7)]


def test_what_they_said_is_told_in_their_order_whoever_is_fastest(group_of):
    slow, fast = Played("slow"), Played("fast")
    group = group_of(slow, fast)
    heard = []
    for played in (fast, slow):
        link = played.ours.link
        link.on_bytes = lambda data, name=link.name: heard.append(name)
        played.mavlink.sendall(b"\0")
        played.wish(2)
    assert group.fly_to(0.0025)
    assert heard == ["slow", "fast"]


def test_it_tells_when_nobody_said_anything(group_of):
    played = Played()
    group = group_of(played)
    played.wish(2)
    assert not group.fly_to(0.0025)


def test_a_simulation_that_takes_its_time_changes_nothing(toy_copter, flights_of):
    """In the meantime the autopilot repeats its request for the next step."""

    def flight(wrongs, pause_s):
        flights = flights_of(toy_copter(wrongs), (0.0, 0.0, 10.0))
        flights.pilot(0).go_to((40.0, 10.0, 15.0))
        track = flown(flights, 0.5)
        time.sleep(pause_s)
        return [*track, *flown(flights, 1, begin=0.5)]

    assert flight({0: {"repeats": True}}, 0.4) == flight({}, 0.0)


def test_an_autopilot_that_hangs_is_given_up(toy_copter, flights_of, monkeypatch):
    monkeypatch.setattr("gradysim.sitl.lock_step._SILENCE_S", 0.5)
    said = failure_of(flights_of, toy_copter({0: {"hangs_at": 2}}))
    assert said.startswith("vehicle 0: ")
    assert "0.5 s" in said


def test_so_is_one_that_hangs_beside_another_that_waits_for_it(toy_copter, monkeypatch):
    monkeypatch.setattr("gradysim.sitl.lock_step._SILENCE_S", 0.5)
    program = toy_copter({0: {"repeats": True}, 1: {"hangs_at": 2}})
    flights = Flights(nodes(program, (0.0, 0.0, 10.0), (0.0, 9.0, 10.0)), REFERENCE)
    with pytest.raises(SitlError, match="vehicle 1: "):
        flights.begin()
    flights.close()


def _interrupt(timeout_s):
    raise KeyboardInterrupt


def test_a_step_that_was_interrupted_goes_on_where_it_was(toy_copter, flights_of, monkeypatch):
    """Ctrl-C during the autopilots' computation: no autopilot is answered twice."""

    def flight(*, interrupted):
        flights = flights_of(toy_copter(), (0.0, 0.0, 10.0), (0.0, 20.0, 10.0))
        flights.pilot(0).go_to((40.0, 10.0, 15.0))
        track = flown(flights, 1)
        if interrupted:
            with monkeypatch.context() as patch:
                patch.setattr(flights._group._selector, "select", _interrupt)
                with pytest.raises(KeyboardInterrupt):
                    flights.advance_to(1.01)
        return [*track, *flown(flights, 1, begin=1.0)]

    assert flight(interrupted=True) == flight(interrupted=False)


@pytest.fixture
def loop():
    loop = VehicleClockLoop()
    yield loop
    loop.cancel_all()


def test_a_sleep_ends_when_its_time_comes_and_not_before(loop):
    task = loop.create_task(asyncio.sleep(1.0, "slept"))
    for now in (0.0, 0.5, 0.99):
        loop.turn(now)
        assert not task.done()
    loop.turn(1.0)
    assert task.result() == "slept"


def test_time_is_what_the_last_turn_said(loop):
    loop.turn(12.5)
    assert loop.time() == 12.5


def test_what_waits_for_a_future_goes_on_in_the_turn_after_it_is_set(loop):
    future = loop.create_future()

    async def wait():
        return await asyncio.wait_for(future, 10)

    task = loop.create_task(wait())
    loop.turn(0.0)
    future.set_result(3)
    loop.turn(0.1)
    assert task.result() == 3


def test_a_limit_of_time_is_that_of_the_clock(loop):
    async def wait():
        await asyncio.wait_for(asyncio.Event().wait(), 2.0)

    task = loop.create_task(wait())
    loop.turn(0.0)
    loop.turn(2.0)
    assert isinstance(task.exception(), TimeoutError)


def test_it_turns_while_another_loop_runs(loop):
    async def notebook():
        task = loop.create_task(asyncio.sleep(1.0, "slept"))
        loop.turn(0.0)
        loop.turn(1.0)
        assert asyncio.get_running_loop() is not loop
        return task.result()

    assert asyncio.run(notebook()) == "slept"


def test_what_is_left_in_the_end_is_cancelled(loop, caplog):
    ends = []

    async def wait():
        try:
            await asyncio.Event().wait()
        finally:
            ends.append(asyncio.get_running_loop())

    loop.create_task(wait())
    loop.turn(0.0)
    loop.cancel_all()
    loop.cancel_all()
    gc.collect()
    assert ends == [loop]
    assert caplog.records == []
