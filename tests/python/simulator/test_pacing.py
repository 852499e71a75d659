"""Simulations that keep to the wall clock, and what is written of it."""

import csv

import pytest

from gradysim.simulator import simulation
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
    assert "2 asked for, 2.0000 reached" in capsys.readouterr().err


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
