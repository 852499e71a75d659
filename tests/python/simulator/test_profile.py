import logging
import time

import pytest

from gradysim.simulator.profiling import EventProfile


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
