"""From the first heartbeat to the start, with the toy in ArduCopter's place."""

import json

import pytest

from gradysim.sitl.error import SitlError
from gradysim.sitl.preparation import prepare
from python.sitl.fleet_flight import HOME, fly, new_fleet

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
    with pytest.raises(SitlError, match="parameter NONESUCH = 1: not confirmed"):
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
