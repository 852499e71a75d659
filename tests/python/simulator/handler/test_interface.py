import pytest

from gradysim.simulator.handler.interface import IAsyncNodeHandler, INodeHandler


class Minimal(INodeHandler):
    @staticmethod
    def get_label():
        return "minimal"

    def inject(self, event_loop):
        pass

    def register_node(self, node):
        pass


def test_the_rest_is_optional():
    handler = Minimal()
    handler.initialize()
    handler.after_simulation_step(0, 0.0)
    handler.finalize()


def test_a_handler_holds_nothing_up_unless_it_says_so():
    assert Minimal().paused_s == 0.0


@pytest.mark.parametrize("missing", ["get_label", "inject", "register_node"])
def test_three_methods_are_needed(missing):
    methods = {name: method for name, method in vars(Minimal).items() if name[0] != "_" and name != missing}
    with pytest.raises(TypeError, match=missing):
        type("Incomplete", (INodeHandler,), methods)()


def test_an_asyncio_handler_needs_no_more():
    methods = {name: method for name, method in vars(Minimal).items() if name[0] != "_"}
    handler = type("Asynchronous", (IAsyncNodeHandler,), methods)()
    handler.inject_async(None, 0.0)
