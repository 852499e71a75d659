import asyncio
import gc
import time

import pytest
from simulated import build, protocol, timers

from gradysim.simulator.handler.interface import IAsyncNodeHandler


class Asynchronous(IAsyncNodeHandler):
    """Runs a coroutine function of the handler, from `initialize` on."""

    def __init__(self, work=None):
        self.work = work
        self.calls = []

    @staticmethod
    def get_label():
        return "asynchronous"

    def inject(self, event_loop):
        self.event_loop = event_loop
        self.calls.append("inject")

    def inject_async(self, asyncio_loop, real_time):
        self.asyncio_loop = asyncio_loop
        self.calls.append(("inject_async", real_time, asyncio_loop.is_running()))

    def register_node(self, node):
        self.calls.append("register_node")

    def initialize(self):
        if self.work is not None:
            self.task = self.asyncio_loop.create_task(self.work(self))


@pytest.mark.parametrize(("real_time", "factor"), [(False, 0.0), (True, 1.0), (2, 2.0)])
def test_an_asyncio_handler_gets_the_loop_after_inject(real_time, factor):
    handler = Asynchronous()
    build(protocol(), handlers=[handler], real_time=real_time)
    assert handler.calls == ["inject", ("inject_async", factor, False), "register_node"]


def test_tasks_run_between_events():
    async def work(handler):
        for _ in range(10):
            handler.calls.append(handler.event_loop.current_time)
            await asyncio.sleep(0)

    handler = Asynchronous(work)
    build(timers(1, 2, 3), handlers=[handler]).start_simulation()
    assert handler.calls[3:] == [0.0, 1.0, 2.0, 3.0]


def test_a_task_brings_an_event_forward_in_real_time():
    async def work(handler):
        handler.event_loop.schedule_event(0.001, lambda: handler.calls.append("brought forward"))

    handler = Asynchronous(work)
    simulator = build(timers(3600), handlers=[handler], real_time=True)
    simulator.run_events(1)
    assert handler.calls[-1] == "brought forward"
    simulator.finalize()


def test_an_event_that_is_brought_forward_comes_when_it_is_due():
    async def work(handler):
        handler.event_loop.schedule_event(0.1, lambda: handler.calls.append(time.monotonic()))

    handler = Asynchronous(work)
    simulator = build(timers(3600), handlers=[handler], real_time=True)
    start = time.monotonic()
    simulator.run_events(1)
    simulator.finalize()
    assert handler.calls[-1] - start >= 0.1


def test_in_real_time_events_come_when_they_are_due(monkeypatch):
    handler = Asynchronous()
    simulator = build(timers(0.01, 0.03), handlers=[handler], real_time=True)
    start = time.monotonic()
    simulator.start_simulation()
    assert time.monotonic() - start >= 0.03


def test_what_a_task_raises_ends_the_simulation():
    async def work(handler):
        raise RuntimeError("deliberate")

    handler = Asynchronous(lambda handler: work(handler))
    simulator = build(timers(1, 2, 3), handlers=[handler])

    def forget():
        handler.task = None

    handler.initialize = lambda: (Asynchronous.initialize(handler), forget())
    with pytest.raises(RuntimeError, match="deliberate"):
        simulator.start_simulation()


def test_in_the_end_tasks_are_cancelled_and_the_loop_is_closed():
    async def work(handler):
        try:
            await asyncio.Event().wait()
        finally:
            handler.calls.append("canceled")

    handler = Asynchronous(work)
    build(timers(1), handlers=[handler]).start_simulation()
    assert (handler.calls[-1], handler.asyncio_loop.is_closed()) == ("canceled", True)


def test_handlers_may_use_the_loop_in_their_own_methods():
    handler = Asynchronous()
    handler.finalize = lambda: handler.asyncio_loop.run_until_complete(asyncio.sleep(0))
    build(timers(1), handlers=[handler]).start_simulation()


def test_a_simulation_that_never_began_leaves_no_open_loop():
    handler = Asynchronous()
    simulator = build(protocol(), handlers=[handler])
    del simulator
    gc.collect()
    assert handler.asyncio_loop.is_closed()
