import pytest

from gradysim.encapsulator.python import PythonProvider
from gradysim.encapsulator.watched_provider import watch_tracked_variables


class Node:
    id = 0


@pytest.fixture
def changes():
    return []


@pytest.fixture
def provider(changes):
    provider = PythonProvider(Node())
    watch_tracked_variables(provider, lambda name, value: changes.append((name, value)))
    return provider


def test_each_assignment_is_told(provider, changes):
    provider.tracked_variables["heard"] = 0
    provider.tracked_variables["heard"] += 1
    assert changes == [("heard", 0), ("heard", 1)]
    assert provider.tracked_variables == {"heard": 1}


def test_another_dictionary_is_watched_too(provider, changes):
    provider.tracked_variables["old"] = 1
    provider.tracked_variables = {"new": 2}
    provider.tracked_variables["new"] = 3
    assert changes == [("old", 1), ("old", None), ("new", 2), ("new", 3)]


def test_items_that_are_merged_are_told_once(provider, changes):
    provider.tracked_variables["old"] = 1
    provider.tracked_variables |= {"new": 2}
    assert changes == [("old", 1), ("new", 2)]


def test_what_was_tracked_before_is_told_first(changes):
    provider = PythonProvider(Node())
    provider.tracked_variables["early"] = 5
    watch_tracked_variables(provider, lambda name, value: changes.append((name, value)))
    assert changes == [("early", 5)]
    assert provider.tracked_variables == {"early": 5}


def test_it_stays_a_provider_of_its_class(provider):
    assert isinstance(provider, PythonProvider)
    assert type(provider).__name__ == "PythonProvider"


def test_others_keep_their_plain_attribute(provider, changes):
    other = PythonProvider(Node())
    other.tracked_variables["heard"] = 1
    assert type(other) is PythonProvider
    assert (type(other.tracked_variables), changes) == (dict, [])
