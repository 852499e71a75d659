"""A loop inside another one."""

import asyncio

import pytest

from gradysim.encapsulator.nested_loop import outer_loop_stands


async def _answer():
    await asyncio.sleep(0)
    return 42


def test_another_loop_may_run_inside():
    async def outer():
        with outer_loop_stands():
            return asyncio.run(_answer())

    assert asyncio.run(outer()) == 42


def test_what_is_inside_does_not_know_of_the_outer_loop():
    async def outer():
        with outer_loop_stands(), pytest.raises(RuntimeError, match="running"):
            asyncio.get_running_loop()

    asyncio.run(outer())


def _fail():
    with outer_loop_stands():
        asyncio.run(_answer())
        raise ZeroDivisionError


def test_after_a_failure_inside_the_outer_loop_and_its_task_go_on():
    async def outer():
        loop, task = asyncio.get_running_loop(), asyncio.current_task()
        with pytest.raises(ZeroDivisionError):
            _fail()
        assert (asyncio.get_running_loop(), asyncio.current_task()) == (loop, task)
        return await asyncio.wait_for(_answer(), 10)

    assert asyncio.run(outer()) == 42


def test_without_an_outer_loop_there_is_none_afterwards():
    with outer_loop_stands():
        assert asyncio.run(_answer()) == 42
    with pytest.raises(RuntimeError, match="running"):
        asyncio.get_running_loop()
