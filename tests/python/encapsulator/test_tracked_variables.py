import copy
import pickle
from collections import UserDict, defaultdict
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.encapsulator.interop import InteropProvider
from gradysim.encapsulator.python import PythonProvider
from gradysim.encapsulator.tracked_variables import TrackedVariables, watch_tracked_variables


@pytest.fixture
def changes():
    return []


@pytest.fixture
def variables(changes):
    variables = TrackedVariables(lambda name, value: changes.append((name, value)))
    variables["a"] = 1
    variables["b"] = 2
    changes.clear()
    return variables


def or_itself(variables):
    variables |= {"a": 3, "c": 4}


@pytest.mark.parametrize(
    ("change", "reported", "result"),
    [
        (lambda v: v.__setitem__("a", 3), [("a", 3)], {"a": 3, "b": 2}),
        (lambda v: v.update({"a": 3}, c=4), [("a", 3), ("c", 4)], {"a": 3, "b": 2, "c": 4}),
        (lambda v: v.update([("c", 4)]), [("c", 4)], {"a": 1, "b": 2, "c": 4}),
        (or_itself, [("a", 3), ("c", 4)], {"a": 3, "b": 2, "c": 4}),
        (lambda v: v.setdefault("c", 4), [("c", 4)], {"a": 1, "b": 2, "c": 4}),
        (lambda v: v.setdefault("a", 4), [], {"a": 1, "b": 2}),
        (lambda v: v.__delitem__("a"), [("a", None)], {"b": 2}),
        (lambda v: v.pop("a"), [("a", None)], {"b": 2}),
        (lambda v: v.pop("z", 0), [], {"a": 1, "b": 2}),
        (lambda v: v.popitem(), [("b", None)], {"a": 1}),
        (lambda v: v.replace({"b": 3, "c": 4}), [("a", None), ("b", 3), ("c", 4)], {"b": 3, "c": 4}),
        (lambda v: v.replace(v), [], {"a": 1, "b": 2}),
        (lambda v: v.clear(), [("a", None), ("b", None)], {}),
    ],
)
def test_every_way_of_changing_is_reported(variables, changes, change, reported, result):
    change(variables)
    assert (changes, dict(variables)) == (reported, result)


@pytest.mark.parametrize("removal", [lambda v: v.__delitem__("z"), lambda v: v.pop("z")])
def test_removing_what_is_not_there_is_an_error(variables, changes, removal):
    with pytest.raises(KeyError):
        removal(variables)
    assert changes == []


def test_return_values_are_those_of_a_dict(variables):
    assert (variables.setdefault("a", 9), variables.pop("a"), variables.pop("a", 5), variables.popitem()) == (
        1,
        1,
        5,
        ("b", 2),
    )


@pytest.mark.parametrize(
    "copied", [copy.copy, copy.deepcopy, dict.copy, lambda v: pickle.loads(pickle.dumps(v))]
)
def test_a_copy_is_a_plain_dict_that_reports_nothing(copied):
    variables = TrackedVariables(lambda name, value: pytest.fail(f"{name} was reported") if armed else None)
    armed = False
    variables["list"] = [1]
    armed = True
    other = copied(variables)
    other["more"] = 1
    assert (type(other), other, variables) == (dict, {"list": [1], "more": 1}, {"list": [1]})


def test_a_deep_copy_shares_nothing(variables):
    variables["list"] = [1]
    variables["itself"] = variables
    other = copy.deepcopy(variables)
    other["list"].append(2)
    assert variables["list"] == [1]
    assert other["itself"] is other


names = st.sampled_from("abc")
operations = st.one_of(
    st.tuples(st.just("__setitem__"), names, st.integers()),
    st.tuples(st.just("setdefault"), names, st.integers()),
    st.tuples(st.just("pop"), names, st.none()),
    st.tuples(st.just("update"), st.dictionaries(names, st.integers())),
    st.tuples(st.just("clear")),
)


@given(st.lists(operations))
def test_the_reports_reproduce_the_dict(steps):
    followed = {}

    def follow(name, value):
        if value is None:
            del followed[name]
        else:
            followed[name] = value

    variables = TrackedVariables(follow)
    for operation, *arguments in steps:
        getattr(variables, operation)(*arguments)
    assert followed == dict(variables)


def test_a_variable_is_not_an_attribute(variables):
    with pytest.raises(AttributeError, match="'c'"):
        variables.c = 3


def plain():
    return PythonProvider(SimpleNamespace(id=0))


def watched():
    provider = plain()
    watch_tracked_variables(provider, lambda name, value: None)
    return provider


def interop():
    return InteropProvider()


all_providers = pytest.mark.parametrize("make", [plain, watched, interop])


@all_providers
@pytest.mark.parametrize("variables", [None, [], ["a"], [("a", 1)], "a", 3])
def test_an_invalid_assignment_is_rejected(make, variables):
    provider = make()
    provider.tracked_variables["a"] = 1
    with pytest.raises(TypeError, match="tracked_variables"):
        provider.tracked_variables = variables
    assert provider.tracked_variables == {"a": 1}


@all_providers
@pytest.mark.parametrize("kind", [dict, UserDict, lambda variables: defaultdict(int, variables)])
def test_another_dictionary_may_be_assigned(make, kind):
    provider = make()
    provider.tracked_variables = kind({"a": 1})
    assert dict(provider.tracked_variables) == {"a": 1}


def test_other_attributes_are_not_checked():
    provider = plain()
    provider.mine = None
    assert provider.mine is None


class Node:
    id = 0


@pytest.fixture
def provider(changes):
    provider = PythonProvider(Node())
    watch_tracked_variables(provider, lambda name, value: changes.append((name, value)))
    return provider


def test_each_assignment_is_reported(provider, changes):
    provider.tracked_variables["heard"] = 0
    provider.tracked_variables["heard"] += 1
    assert changes == [("heard", 0), ("heard", 1)]
    assert provider.tracked_variables == {"heard": 1}


def test_an_assigned_dictionary_is_watched(provider, changes):
    provider.tracked_variables["old"] = 1
    provider.tracked_variables = {"new": 2}
    provider.tracked_variables["new"] = 3
    assert changes == [("old", 1), ("old", None), ("new", 2), ("new", 3)]


def test_merged_items_are_reported_once(provider, changes):
    provider.tracked_variables["old"] = 1
    provider.tracked_variables |= {"new": 2}
    assert changes == [("old", 1), ("new", 2)]


def test_earlier_variables_are_reported_first(changes):
    provider = PythonProvider(Node())
    provider.tracked_variables["early"] = 5
    watch_tracked_variables(provider, lambda name, value: changes.append((name, value)))
    assert changes == [("early", 5)]
    assert provider.tracked_variables == {"early": 5}


def test_the_provider_keeps_its_class(provider):
    assert isinstance(provider, PythonProvider)
    assert type(provider).__name__ == "PythonProvider"


def test_other_providers_keep_a_plain_attribute(provider, changes):
    other = PythonProvider(Node())
    other.tracked_variables["heard"] = 1
    assert type(other) is PythonProvider
    assert (type(other.tracked_variables), changes) == (dict, [])
