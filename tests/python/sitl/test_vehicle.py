"""Steps of a vehicle, one by one: with the toy, and with made-up answers."""

import asyncio
import json

import pytest

from gradysim.sitl import SitlError
from gradysim.sitl.mavlink import COPTER_GUIDED, MavlinkLink, load_dialect
from gradysim.sitl.vehicle import Vehicle, prepare
from python.sitl.fleet_flight import HOME, fly, new_fleet, ready

pytestmark = pytest.mark.usefixtures("own_folder")

mavlink = load_dialect()


def test_a_flight(toy_copter):
    async def steps(vehicle):
        await ready(vehicle)
        await vehicle.enter_guided(10)
        await vehicle.arm(10)
        await vehicle.take_off(10, 10)
        await vehicle.arrive(HOME[0] + 1e-4, HOME[1], 15, 10)
        return vehicle.position

    assert fly(new_fleet(toy_copter()), steps) == pytest.approx((HOME[0] + 1e-4, HOME[1], 15), abs=1)


def test_a_take_off_without_arming_is_an_error_and_no_progress(toy_copter):
    async def steps(vehicle):
        await ready(vehicle)
        await vehicle.take_off(10, 10)

    with pytest.raises(SitlError, match=r"^vehicle 0: .*MAV_RESULT_FAILED"):
        fly(new_fleet(toy_copter()), steps)


def test_a_speed_that_is_refused_is_an_error(toy_copter):
    with pytest.raises(SitlError, match=r"^vehicle 0: .* -1 .*MAV_RESULT_FAILED"):
        fly(new_fleet(toy_copter()), lambda vehicle: vehicle.set_speed(-1))


def test_a_parameter_that_is_not_confirmed_is_an_error(toy_copter, monkeypatch):
    monkeypatch.setattr("gradysim.sitl.vehicle._ANSWER_S", 0.05)
    with pytest.raises(SitlError, match=r"^vehicle 0: .* NONESUCH = 1: .* 5 "):
        fly(new_fleet(toy_copter()), lambda vehicle: vehicle.set_parameter("NONESUCH", 1))


def test_a_message_that_seems_to_be_refused_is_asked_for_again(toy_copter):
    fly(new_fleet(toy_copter({0: {"refuses_first": True}})), ready)


class Played:
    """Autopilot's side of a link: `says` what the test sets, and records what it gets."""

    def __init__(self):
        self.link = MavlinkLink("vehicle 0")
        self.link.send_bytes = self._take
        self.codec = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
        self.got = []
        self.answers = []  # one for each received message, as long as there are some

    def says(self, *messages):
        for message in messages:
            self.link.feed(message.pack(self.codec))

    def _take(self, data):
        self.got += mavlink.MAVLink(None).parse_buffer(data)
        if self.answers:
            asyncio.get_running_loop().call_soon(self.says, *self.answers.pop(0))


def heartbeat(*, armed=True, mode=COPTER_GUIDED):
    return mavlink.MAVLink_heartbeat_message(2, 3, 1 | 128 * armed, mode, 4, 3)


def ack(command, result=mavlink.MAV_RESULT_ACCEPTED):
    return mavlink.MAVLink_command_ack_message(command, result)


@pytest.fixture
def played():
    played = Played()
    played.says(heartbeat())
    return played


@pytest.fixture
def vehicle(played):
    return Vehicle(played.link)


SPEED = mavlink.MAV_CMD_DO_CHANGE_SPEED


def test_neither_the_answer_to_another_command_nor_that_of_one_under_way_is_its_answer(played, vehicle):
    others = (ack(mavlink.MAV_CMD_NAV_TAKEOFF), ack(SPEED, mavlink.MAV_RESULT_IN_PROGRESS))
    played.answers = [(*others, ack(SPEED, mavlink.MAV_RESULT_DENIED))]
    with pytest.raises(SitlError, match=r"^vehicle 0: .* 3 .*MAV_RESULT_DENIED"):
        asyncio.run(vehicle.set_speed(3))


def test_commands_that_are_sent_again_count_their_tries(played, vehicle, monkeypatch):
    """The count tells the autopilot that it may have obeyed before."""
    monkeypatch.setattr("gradysim.sitl.vehicle._ANSWER_S", 0.01)
    played.answers = [(), (), (ack(SPEED),)]
    asyncio.run(vehicle.set_speed(3))
    assert [message.confirmation for message in played.got] == [0, 1, 2]


def test_a_parameter_of_another_value_is_not_confirmed(played, vehicle, monkeypatch):
    monkeypatch.setattr("gradysim.sitl.vehicle._ANSWER_S", 0.01)
    played.answers = [(mavlink.MAVLink_param_value_message(b"SIM_WIND_SPD", 4.0, 9, 1, 0),)]
    with pytest.raises(SitlError, match=r"SIM_WIND_SPD = 5: "):
        asyncio.run(vehicle.set_parameter("SIM_WIND_SPD", 5.0))


def test_one_that_flies_already_is_neither_armed_nor_lifted(played, vehicle):
    played.says(mavlink.MAVLink_extended_sys_state_message(0, mavlink.MAV_LANDED_STATE_IN_AIR))
    asyncio.run(vehicle.arm(1))
    asyncio.run(vehicle.take_off(10, 1))
    assert played.got == []


def test_a_flight_ends_when_its_motors_stop(played, vehicle):
    played.answers = [(heartbeat(armed=False),)]
    with pytest.raises(SitlError, match=r"^vehicle 0: .*\(1\.0000000, 2\.0000000, 3 m\): .*motors"):
        asyncio.run(vehicle.arrive(1, 2, 3, 10))


def test_up_is_down_in_the_frame_of_a_velocity(played, vehicle):
    vehicle.set_velocity(1, 2, 3)
    (order,) = played.got
    assert (order.coordinate_frame, order.vx, order.vy, order.vz) == (mavlink.MAV_FRAME_LOCAL_NED, 1, 2, -3)


def test_a_failure_tells_each_text_once(played, vehicle):
    for text in (b"no GPS", b"no compass", b"no GPS"):
        played.says(mavlink.MAVLink_statustext_message(2, text))
    played.says(heartbeat(armed=False))
    with pytest.raises(SitlError, match=r': "no GPS"; "no compass"$'):
        vehicle.check_flight()


@pytest.mark.parametrize(("told", "known"), [(55, 55.0), (0, 0.0), (-1, None)])
def test_a_battery_of_minus_1_percent_is_unknown(played, vehicle, told, known):
    assert vehicle.battery_percent is None
    played.says(mavlink.MAVLink_sys_status_message(0, 0, 0, 0, 12000, 0, told, *([0] * 6)))
    assert vehicle.battery_percent == known


pytestmark = pytest.mark.usefixtures("own_folder")

START = (HOME[0] + 1e-4, HOME[1], 15.0)


async def prepared(vehicle, **settings):
    wishes = {"position_hz": 10, "speed_mps": 7.0, "timeout_s": 10, "parameters": {}, **settings}
    await prepare(vehicle, START, **wishes)


def final_state(program):
    return json.loads(program.with_name("final_0.json").read_text())


def test_it_hovers_at_its_start(toy_copter):
    async def steps(vehicle):
        await prepared(vehicle)
        vehicle.check_flight()
        return vehicle.position

    assert fly(new_fleet(toy_copter()), steps) == pytest.approx(START, abs=1)


def test_it_has_its_speed_then(toy_copter):
    program = toy_copter()
    fly(new_fleet(program), prepared)
    assert final_state(program)["speed"] == 7


def test_a_parameter_that_it_does_not_confirm_keeps_it_on_the_ground(toy_copter, monkeypatch):
    monkeypatch.setattr("gradysim.sitl.vehicle._ANSWER_S", 0.05)
    program = toy_copter()
    with pytest.raises(SitlError, match="NONESUCH = 1: "):
        fly(new_fleet(program), lambda vehicle: prepared(vehicle, parameters={"NONESUCH": 1.0}))
    assert final_state(program)["target"] is None


def test_who_refuses_it_knows_where_it_is_and_keeps_it_on_the_ground(toy_copter):
    async def steps(vehicle):
        def refuse():
            raise SitlError(f"at {vehicle.position}, {vehicle.is_armed}")

        with pytest.raises(SitlError) as caught:
            await prepared(vehicle, check=refuse)
        return str(caught.value)

    program = toy_copter()
    assert fly(new_fleet(program), steps) == f"at {(*HOME[:2], 0.0)}, False"
    assert final_state(program)["target"] is None
