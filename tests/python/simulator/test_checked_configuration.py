import pytest

from gradysim.simulator.handler.communication import CommunicationMedium
from gradysim.simulator.validation import checked_configuration


def test_what_was_given_is_taken_as_it_is():
    medium = CommunicationMedium(1)
    assert checked_configuration(medium, CommunicationMedium) is medium


def test_without_any_there_are_defaults():
    assert checked_configuration(None, CommunicationMedium) == CommunicationMedium()


@pytest.mark.parametrize("wrong", ["medium", 0, {}, CommunicationMedium])
def test_anything_else_is_refused(wrong):
    with pytest.raises(TypeError, match="expected a CommunicationMedium, got"):
        checked_configuration(wrong, CommunicationMedium)
