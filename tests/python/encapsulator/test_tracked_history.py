import pytest

from gradysim.encapsulator.tracked_history import TrackedHistory


class Clock:
    time_s = 0.0

    def __call__(self):
        return self.time_s


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def history(clock):
    return TrackedHistory(clock)


def test_changes_are_noted_with_their_times(history, clock):
    history.note("a", 1)
    clock.time_s = 2.5
    history.note("b", "x")
    history.note("a", 2)
    assert history.values == [(0.0, "a", 1), (2.5, "b", "x"), (2.5, "a", 2)]


@pytest.mark.parametrize("value", [0, 1.5, "text", True, None])
def test_a_plain_value_that_is_assigned_again_is_no_change(history, value):
    history.note("a", value)
    history.note("a", value)
    assert len(history.values) == 1


def test_a_value_of_another_type_is_a_change(history):
    history.note("a", 1)
    history.note("a", True)
    history.note("a", 1.0)
    assert [type(entry.value) for entry in history.values] == [int, bool, float]


def test_an_object_that_is_assigned_again_may_have_changed(history):
    values = []
    history.note("a", values)
    history.note("a", values)
    assert len(history.values) == 2


def test_a_value_that_comes_back_is_a_change(history):
    for value in (1, 2, 1):
        history.note("a", value)
    assert [entry.value for entry in history.values] == [1, 2, 1]
