import csv
import logging

import pytest

from gradysim.simulator.profiling import TimingReport


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
    assert lines[5] == f"real_time: 2 asked for, 2.0000 reached; all events: {path}"


def test_without_events_there_is_nothing_to_sum_up(path, caplog):
    caplog.set_level(logging.INFO)
    report = TimingReport(path, 1.0)
    report.log_summary()
    report.close()
    assert caplog.messages[0].splitlines()[4].split() == ["time_drift", "-", "-", "-"]
