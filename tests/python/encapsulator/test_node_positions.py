from types import SimpleNamespace

import pytest

from gradysim.encapsulator.interop import InteropProvider
from gradysim.encapsulator.node_positions import NodePositions
from gradysim.encapsulator.python import PythonProvider


def test_in_prototype_mode_the_mobility_handler_knows():
    mobility = SimpleNamespace(nodes={3: SimpleNamespace(position=(1, 2, 3))}, handle_command=None)
    provider = PythonProvider(SimpleNamespace(id=3), mobility=mobility)
    assert isinstance(provider, NodePositions)
    assert provider.node_positions() == {3: (1, 2, 3)}


def test_without_a_mobility_handler_nobody_knows():
    with pytest.raises(RuntimeError, match="no mobility handler"):
        PythonProvider(SimpleNamespace(id=0)).node_positions()


def test_a_host_outside_does_not_tell():
    assert not isinstance(InteropProvider(), NodePositions)
