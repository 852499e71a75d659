import math

import pytest

from gradysim.simulator.handler.communication import CommunicationMedium
from gradysim.simulator.simulation import SimulationBuilder
from gradysim.simulator.validation import check_reference, checked_configuration, checked_protocol_class
from python.simulator.simulator.simulated import protocol


def test_what_was_given_is_taken_as_it_is():
    medium = CommunicationMedium(1)
    assert checked_configuration(medium, CommunicationMedium) is medium


def test_without_any_there_are_defaults():
    assert checked_configuration(None, CommunicationMedium) == CommunicationMedium()


@pytest.mark.parametrize("wrong", ["medium", 0, {}, CommunicationMedium])
def test_anything_else_is_refused(wrong):
    with pytest.raises(TypeError, match="CommunicationMedium"):
        checked_configuration(wrong, CommunicationMedium)


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


@pytest.mark.parametrize("place", [(0, 0, 0), (90, -200.5, 1e3), [-90, 0, -5]])
def test_a_place_is_right(place):
    check_reference(place)


@pytest.mark.parametrize(
    "place",
    [(90.1, 0, 0), (-91, 0, 0), (0, math.inf, 0), (0, 0, math.nan), (0, 0), "abc", None, (0, 0, 0, 0)],
)
def test_anything_else_is_refused_by_value(place):
    with pytest.raises(ValueError, match="reference_coordinates") as caught:
        check_reference(place)
    assert str(caught.value).endswith(repr(place))
