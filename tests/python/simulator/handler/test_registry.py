import pytest

from gradysim.simulator.handler.interface import IAsyncNodeHandler, INodeHandler
from gradysim.simulator.handler.registry import WORLD, handlers_by_label, step_hooks


class Watching(INodeHandler):
    def __init__(self, label="watching"):
        self.label = label

    def get_label(self):
        return self.label

    def inject(self, event_loop): ...

    def register_node(self, node): ...


class Waiting(Watching, IAsyncNodeHandler): ...


class Stepping(Watching):
    def after_simulation_step(self, iteration, timestamp): ...


def given(*handlers, asynchronous=False):
    return handlers_by_label(handlers, "test mode", "it has a {label} of its own", asynchronous=asynchronous)


def test_by_label_in_the_order_given():
    second, first = Watching("b"), Watching("a")
    assert list(given(second, first).items()) == [("b", second), ("a", first)]


@pytest.mark.parametrize("wrong", [Watching, None, "watching"])
def test_something_else(wrong):
    with pytest.raises(TypeError):
        given(wrong)


def test_one_handler_is_no_list():
    with pytest.raises(TypeError, match="Watching"):
        handlers_by_label(Watching(), "test mode", "", asynchronous=False)


@pytest.mark.parametrize("label", WORLD)
def test_the_world_is_not_to_be_given(label):
    expected = f"Watching cannot be given to a run in test mode: it has a {label} of its own"
    with pytest.raises(ValueError, match=expected):
        given(Watching(label))


def test_two_of_one_label():
    with pytest.raises(ValueError, match=r"'a': Watching.*Stepping"):
        given(Watching("a"), Stepping("a"))


def test_asynchronous_handlers_where_they_work():
    handler = Waiting()
    assert given(handler, asynchronous=True) == {"watching": handler}


def test_asynchronous_handlers_elsewhere():
    with pytest.raises(ValueError, match=r"Waiting .*test"):
        given(Waiting())


def test_only_those_that_do_something_then_have_a_hook():
    stepping = Stepping()
    assert step_hooks([Watching(), stepping]) == [stepping.after_simulation_step]


def test_a_hook_may_be_the_instances_own():
    handler, calls = Watching(), []
    handler.after_simulation_step = lambda iteration, timestamp: calls.append((iteration, timestamp))
    (hook,) = step_hooks([handler])
    hook(0, 1.5)
    assert calls == [(0, 1.5)]
