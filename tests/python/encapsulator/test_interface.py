from types import SimpleNamespace

import pytest

from gradysim.encapsulator.interface import IEncapsulator, NodePositions
from gradysim.encapsulator.interop import InteropProvider
from gradysim.encapsulator.python import PythonProvider


def test_an_encapsulator_must_have_every_method():
    assert IEncapsulator.__abstractmethods__ == {
        "encapsulate",
        "initialize",
        "handle_timer",
        "handle_packet",
        "handle_telemetry",
        "finish",
    }


def test_in_prototype_mode_the_mobility_handler_has_the_positions():
    mobility = SimpleNamespace(nodes={3: SimpleNamespace(position=(1, 2, 3))}, handle_command=None)
    provider = PythonProvider(SimpleNamespace(id=3), mobility=mobility)
    assert isinstance(provider, NodePositions)
    assert provider.node_positions() == {3: (1, 2, 3)}


def test_without_a_mobility_handler_positions_are_unknown():
    with pytest.raises(RuntimeError):
        PythonProvider(SimpleNamespace(id=0)).node_positions()


def test_the_interop_provider_has_no_positions():
    assert not isinstance(InteropProvider(), NodePositions)
