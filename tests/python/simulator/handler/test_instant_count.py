import pytest

from gradysim.simulator import event
from gradysim.simulator.event import InstantCount


@pytest.fixture
def count(monkeypatch):
    monkeypatch.setattr(event, "MOST_AT_ONE_INSTANT", 3)
    return InstantCount()


def test_it_exceeds_the_bound_with_the_next_one(count):
    assert [count.exceeds(2.5) for _ in range(5)] == [False, False, False, True, True]


def test_it_begins_anew_at_each_instant(count):
    assert not any(count.exceeds(instant) for instant in (0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0))
