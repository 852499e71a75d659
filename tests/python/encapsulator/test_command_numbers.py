import math
from decimal import Decimal
from fractions import Fraction

import pytest

from gradysim.encapsulator.command_numbers import finite_number, three_numbers
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetSpeedMobilityCommand


@pytest.mark.parametrize("value", [1, 1.0, Fraction(1), Decimal(1)])
def test_what_is_a_number_becomes_a_float(value):
    assert (finite_number(value), type(finite_number(value))) == (1.0, float)


@pytest.mark.parametrize(
    "value", [math.nan, -math.inf, pytest.param(10**400, id="huge"), None, "1", [1], 1j, object()]
)
def test_anything_else_is_no_number(value):
    assert finite_number(value) is None


def test_three_numbers_of_a_command():
    assert three_numbers(GotoCoordsMobilityCommand(1, 2.5, -3)) == (1.0, 2.5, -3.0)


@pytest.mark.parametrize("place", range(3))
def test_one_that_is_none_is_enough(place):
    numbers = [1.0, 2.0, 3.0]
    numbers[place] = math.nan
    assert three_numbers(GotoCoordsMobilityCommand(*numbers)) is None


def test_a_command_with_fewer_has_not_three():
    assert three_numbers(SetSpeedMobilityCommand(5)) is None
