import warnings

import pytest

from gradysim.encapsulator.python import PythonProvider
from gradysim.simulator.extension.extension import Extension, handler_of, mode_of
from gradysim.simulator.handler.timer import TimerHandler


def test_in_prototype_mode_it_has_the_provider(protocols):
    (protocol,) = protocols([(0, 0, 0)])
    assert Extension(protocol)._provider is protocol.provider


def test_elsewhere_it_has_none_and_says_so(hosted):
    with pytest.warns(UserWarning, match="InteropProvider"):
        extension = Extension(hosted)
    assert extension._provider is None


def test_in_prototype_mode_there_is_no_warning(protocols):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Extension(*protocols([(0, 0, 0)]))


@pytest.mark.parametrize("has_none", [True, False])
def test_without_a_provider_it_cannot_be(idle, has_none):
    protocol = idle()
    if has_none:
        protocol.provider = None
    with pytest.raises(ReferenceError, match="Quiet"):
        Extension(protocol)


def test_a_handler_is_found_by_its_label(protocols):
    timers = TimerHandler()
    (protocol,) = protocols([(0, 0, 0)], timers)
    assert (handler_of(protocol, "timer"), handler_of(protocol, "battery")) == (timers, None)


def test_elsewhere_there_are_no_handlers(hosted):
    assert handler_of(hosted, "timer") is None


def test_without_a_provider_nobody_knows_of_handlers(idle):
    with pytest.raises(ReferenceError, match="Quiet"):
        handler_of(idle(), "timer")


def test_modes_have_names():
    assert mode_of(PythonProvider) == "prototype mode"
