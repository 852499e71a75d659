from collections import UserDict, defaultdict
from types import SimpleNamespace

import pytest

from gradysim.encapsulator.interop import InteropProvider
from gradysim.encapsulator.python import PythonProvider
from gradysim.encapsulator.watched_provider import watch_tracked_variables


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
def test_what_are_no_variables_is_refused_where_it_is_assigned(make, variables):
    provider = make()
    provider.tracked_variables["a"] = 1
    with pytest.raises(TypeError, match=r"^tracked_variables = .*: expected a dict$"):
        provider.tracked_variables = variables
    assert provider.tracked_variables == {"a": 1}


@all_providers
@pytest.mark.parametrize("kind", [dict, UserDict, lambda variables: defaultdict(int, variables)])
def test_another_dictionary_may_be_assigned(make, kind):
    provider = make()
    provider.tracked_variables = kind({"a": 1})
    assert dict(provider.tracked_variables) == {"a": 1}


def test_other_attributes_are_nobodys_business():
    provider = plain()
    provider.mine = None
    assert provider.mine is None
