import pytest
from simulated import build, protocol

from gradysim.simulator.configuration import SimulationConfiguration
from gradysim.simulator.simulator import Simulator


def test_an_unknown_node_is_an_error():
    with pytest.raises(KeyError, match="5"):
        build(protocol()).get_node(5)


def test_an_id_is_given_once():
    simulator = build(protocol())
    with pytest.raises(ValueError, match="0"):
        simulator.create_node((0, 0, 0), protocol(), 0)


def test_a_wrong_configuration_is_refused():
    with pytest.raises(ValueError, match="real_time"):
        Simulator({}, SimulationConfiguration(real_time=-1))
