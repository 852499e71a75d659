import csv
import logging
import time

import pytest

from gradysim.simulator.profiling import EventProfile, TimingReport


def test_the_report_counts_events_by_context(caplog):
    profile = EventProfile()
    for context in ("a", "b", "a"):
        profile.run((lambda: None, context))
    profile.report()
    rows = [line.split()[:2] for line in caplog.text.splitlines()]
    assert ["a", "2"] in rows
    assert ["b", "1"] in rows


def test_the_context_that_took_the_longest_comes_first(caplog, monkeypatch):
    monkeypatch.setattr(time, "perf_counter", iter((0.0, 1.0, 1.0, 4.0, 4.0, 6.0)).__next__)
    profile = EventProfile()
    for context in ("short", "long", "medium"):
        profile.run((lambda: None, context))
    profile.report()
    rows = [line.split() for line in caplog.text.splitlines()]
    assert [(row[0], float(row[2])) for row in rows if row and row[0] in ("short", "long", "medium")] == [
        *(("long", 3.0), ("medium", 2.0), ("short", 1.0))
    ]


def test_the_report_is_a_warning(caplog):
    EventProfile().report()
    assert [record.levelno for record in caplog.records] == [logging.WARNING]


def test_a_failing_event_counts_and_fails(caplog):
    def fail():
        raise LookupError("broken")

    profile = EventProfile()
    with pytest.raises(LookupError):
        profile.run((fail, "a"))
    profile.report()
    assert ["a", "1"] in [line.split()[:2] for line in caplog.text.splitlines()]


@pytest.fixture
def path(tmp_path):
    return tmp_path / "timing_report.csv"


def test_a_line_for_each_event(path):
    report = TimingReport(path, 2.0)
    report.note(0, 0.1, 0.06, 0.049, 0.01)
    report.note(1, 0.2, 0.1, 0.04, 0.0)
    report.close()
    with path.open(newline="") as file:
        assert list(csv.reader(file)) == [
            ["iteration", "simulation_time", "real_time", "time_until_next_event", "time_drift"],
            ["0", "0.1", "0.06", "0.049", "0.01"],
            ["1", "0.2", "0.1", "0.04", "0.0"],
        ]


def test_a_report_of_an_earlier_run_is_replaced(path):
    path.write_text("old")
    TimingReport(path, 1.0).close()
    assert path.read_text().startswith("iteration,")


def test_the_summary(path, caplog):
    caplog.set_level(logging.INFO)
    report = TimingReport(path, 2.0)
    report.note(0, 1.0, 0.5, 0.25, 0.01)
    report.note(1, 2.0, 1.0, 0.75, 0.03)
    report.log_summary()
    report.close()
    lines = caplog.messages[0].splitlines()
    assert lines[3].split() == ["time_until_next_event", "0.7500", "0.5000", "0.7500"]
    assert lines[4].split() == ["time_drift", "0.0300", "0.0200", "0.0300"]
    assert " 2.0000 " in lines[5]
    assert lines[5].endswith(f": {path}")


def test_without_events_there_is_nothing_to_sum_up(path, caplog):
    caplog.set_level(logging.INFO)
    report = TimingReport(path, 1.0)
    report.log_summary()
    report.close()
    assert caplog.messages[0].splitlines()[4].split() == ["time_drift", "-", "-", "-"]
