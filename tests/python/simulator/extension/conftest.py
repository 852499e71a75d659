import pytest

from gradysim.encapsulator.interop import InteropEncapsulator
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import Quiet


@pytest.fixture(scope="module")
def idle():
    return Quiet


@pytest.fixture
def simulation():
    """Return a function that makes a simulation of nodes at these points, with these handlers."""

    def make(points, *handlers, protocol=Quiet):
        builder = SimulationBuilder(SimulationConfiguration(execution_logging=False, seed=1))
        for handler in handlers:
            builder.add_handler(handler)
        for point in points:
            builder.add_node(protocol, point)
        return builder.build()

    return make


@pytest.fixture
def protocols(simulation):
    """Return the protocols of such a simulation."""

    def make(points, *handlers, protocol=Quiet):
        nodes = simulation(points, *handlers, protocol=protocol).nodes
        return [node.protocol_encapsulator.protocol for node in nodes]

    return make


@pytest.fixture
def hosted():
    """Return a protocol in another environment."""
    encapsulator = InteropEncapsulator()
    encapsulator.encapsulate(Quiet)
    return encapsulator.protocol
