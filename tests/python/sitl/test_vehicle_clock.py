"""An asyncio loop on the vehicles' time."""

import asyncio
import gc

import pytest

from gradysim.sitl.vehicle_clock import VehicleClockLoop


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
