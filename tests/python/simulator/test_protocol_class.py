import pytest

from gradysim.simulator.simulation import SimulationBuilder
from gradysim.simulator.validation import checked_protocol_class
from python.simulator.simulator.simulated import protocol


def test_the_class_of_a_protocol_is_returned():
    tested = protocol()
    assert checked_protocol_class(tested) is tested


@pytest.mark.parametrize("wrong", [int, "text", None])
def test_what_is_no_protocol_class_is_refused(wrong):
    with pytest.raises(TypeError, match="protocol's class"):
        checked_protocol_class(wrong)


def test_it_is_refused_when_the_node_is_added():
    with pytest.raises(TypeError, match="protocol's class"):
        SimulationBuilder().add_node(int, (0, 0, 0))


def test_an_instance_of_a_protocol_is_refused():
    with pytest.raises(TypeError, match="protocol's class"):
        checked_protocol_class(protocol()())
