"""Simulations in real time, and their timing reports."""

import asyncio
import csv

import pytest

from gradysim.simulator import simulation
from gradysim.simulator.pacing import AsyncioRunner, WakingEventLoop
from python.simulator.simulator.simulated import build, timers


@pytest.mark.parametrize(("real_time", "wall_s"), [(False, 0), (0, 0), (True, 10), (4.0, 2.5)])
def test_real_time(wall_clock, real_time, wall_s):
    build(timers(3, 10, 50), real_time=real_time, duration=20).start_simulation()
    assert wall_clock.now - 100 == wall_s


def test_an_event_at_the_very_end_is_waited_for(wall_clock):
    build(timers(10), real_time=True, duration=10).start_simulation()
    assert wall_clock.now - 100 == 10


def test_real_time_can_be_turned_off(wall_clock):
    with simulation._ForceFastExecution():
        build(timers(10), real_time=True).start_simulation()
    assert wall_clock.now - 100 == 0


def test_turning_real_time_off_ends_with_the_context(wall_clock):
    with simulation._ForceFastExecution():
        pass
    build(timers(10), real_time=True).start_simulation()
    assert wall_clock.now - 100 == 10


def report_of(folder):
    with (folder / "timing_report.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def test_the_timing_report(wall_clock, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)

    def late(self, timer):
        wall_clock.now += 3.0 if timer == "4" else 0.0

    tested = timers(4, 6, 20)
    tested.handle_timer = late
    build(tested, real_time=2, timing_report=True).start_simulation()
    columns = ["iteration", "simulation_time", "real_time", "time_until_next_event", "time_drift"]
    assert [[float(line[column]) for column in columns] for line in report_of(tmp_path)] == [
        [0, 4, 2, 2, 0],
        [1, 6, 5, -2, 2],
        [2, 20, 10, 5, 0],
    ]
    assert " 2.0000 " in capsys.readouterr().err


@pytest.mark.parametrize("configuration", [{"real_time": True}, {"timing_report": True}])
def test_there_is_a_timing_report_only_in_real_time_and_if_asked_for(
    wall_clock, tmp_path, monkeypatch, configuration
):
    monkeypatch.chdir(tmp_path)
    build(timers(1), **configuration).start_simulation()
    assert list(tmp_path.iterdir()) == []


def test_the_timing_report_is_there_after_a_failure(wall_clock, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tested = timers(1)
    tested.handle_timer = lambda self, timer: 1 / 0
    with pytest.raises(ZeroDivisionError):
        build(tested, real_time=True, timing_report=True).start_simulation()
    assert len(report_of(tmp_path)) == 1


@pytest.fixture
def turns():
    turns = AsyncioRunner()
    yield turns
    turns.close()


def test_a_turn_runs_what_is_ready(turns):
    calls = []
    turns.asyncio_loop.call_soon(calls.append, "called")
    turns.run_for(0)
    assert calls == ["called"]


def test_between_turns_the_loop_stands(turns):
    turns.run_for(0)
    assert not turns.asyncio_loop.is_running()


@pytest.mark.parametrize("duration_s", [0.5, 60])
def test_a_longer_turn_runs_what_becomes_ready(turns, duration_s):
    calls = []
    turns.asyncio_loop.call_later(0.001, lambda: (calls.append("called"), turns.wake()))
    turns.run_for(duration_s)
    assert calls == ["called"]


def test_waking_without_a_turn_does_nothing(turns):
    turns.wake()
    calls = []
    turns.asyncio_loop.call_soon(calls.append, "called")
    turns.run_for(0)
    assert calls == ["called"]


def test_what_a_callback_raises_is_raised(turns):
    turns.asyncio_loop.call_soon(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        turns.run_for(60)


async def failing():
    raise RuntimeError("deliberate")


def test_what_a_task_raises_and_nobody_takes_is_raised(turns):
    turns.asyncio_loop.create_task(failing())
    with pytest.raises(RuntimeError, match="deliberate"):
        turns.run_for(60)


def test_a_failure_is_raised_once(turns):
    turns.asyncio_loop.call_soon(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        turns.run_for(0)
    turns.run_for(0)


def test_an_asyncio_report_without_an_exception_is_logged(turns, caplog):
    turns.asyncio_loop.call_exception_handler({"message": "something"})
    turns.run_for(0)
    assert "something" in caplog.text


def test_closing_cancels_tasks():
    turns = AsyncioRunner()
    ends = []

    async def waiting():
        try:
            await asyncio.Event().wait()
        finally:
            ends.append("ended")

    turns.asyncio_loop.create_task(waiting())
    turns.run_for(0)
    turns.close()
    assert (ends, turns.asyncio_loop.is_closed()) == (["ended"], True)


def test_closing_twice_does_nothing():
    turns = AsyncioRunner()
    turns.close()
    turns.close()


def test_inside_another_loop_it_is_closed_without_a_turn():
    turns = AsyncioRunner()

    async def close():
        turns.close()

    asyncio.run(close())
    assert turns.asyncio_loop.is_closed()


def test_an_event_that_a_task_schedules_ends_the_turn(turns):
    event_loop = WakingEventLoop(turns)
    turns.asyncio_loop.call_soon(lambda: event_loop.schedule_event(1.0, lambda: None))
    turns.run_for(60)
    assert event_loop.next_time() == 1.0


def test_an_event_scheduled_between_turns_is_an_event_as_any(turns):
    event_loop = WakingEventLoop(turns)
    event_loop.schedule_event(1.0, lambda: None, "context")
    assert event_loop.pop_event().context == "context"


# A handler that runs the loop itself


def test_an_event_that_is_scheduled_meanwhile_does_not_stop_the_loop(turns):
    event_loop = WakingEventLoop(turns)

    async def schedule():
        event_loop.schedule_event(1, lambda: None)
        await asyncio.sleep(0)
        return "done"

    assert turns.asyncio_loop.run_until_complete(schedule()) == "done"


def test_a_failure_meanwhile_is_raised_by_the_next_turn(turns):
    turns.asyncio_loop.call_soon(lambda: 1 / 0)
    turns.asyncio_loop.run_until_complete(asyncio.sleep(0))
    with pytest.raises(ZeroDivisionError):
        turns.run_for(0)


def test_a_failure_after_the_last_turn_is_logged(caplog):
    turns = AsyncioRunner()
    turns.asyncio_loop.call_soon(lambda: 1 / 0)
    turns.close()
    (record,) = caplog.records
    assert "ZeroDivisionError" in caplog.text
    assert record.levelname == "ERROR"
