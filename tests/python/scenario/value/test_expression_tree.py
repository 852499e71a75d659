"""Nodes of expressions: which of their parts they work out, and for whom."""

from typing import NoReturn

import pytest

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.expression_tree import (
    Node,
    called,
    chain,
    choice,
    constant,
    drawn,
    index,
    index_above,
    selection,
    signed,
)
from gradysim.scenario.value.parameter_context import ParameterContext
from gradysim.scenario.value.quantity import Quantity

PARAMETER = ParameterContext(1, "uavs[3].wlan[2].bitrate")
YES, NO = constant(True), constant(False)


def never(parameter: ParameterContext | None) -> NoReturn:
    pytest.fail("this part is left aside")


def plain(number: int) -> Node:
    return constant(Quantity(number))


def test_a_choice_works_out_conditions_up_to_the_first_that_holds() -> None:
    assert choice([(NO, never), (YES, plain(2)), (never, never)], never)(None) == Quantity(2)
    assert choice([(NO, never)], plain(3))(None) == Quantity(3)


def test_a_chain_goes_on_with_what_it_has() -> None:
    assert chain(plain(8), [("-", plain(4)), ("-", plain(2))])(None) == Quantity(2)


@pytest.mark.parametrize(("first", "sign"), [(NO, "&&"), (YES, "||")])
def test_what_is_decided_works_out_no_more(first: Node, sign: str) -> None:
    assert chain(first, [(sign, never), (sign, never)])(None) is first(None)


def test_a_decision_holds_for_its_operator_alone() -> None:
    assert chain(NO, [("&&", never), ("||", YES)])(None) is True


def test_a_selection_works_out_one_item() -> None:
    assert selection([plain(1), never, plain(7), never])(None) == Quantity(7)


def test_each_parameter_has_its_own_index() -> None:
    other = ParameterContext(1, "uavs[4].wlan[0].bitrate")
    above = index_above("parentIndex", [])
    assert [above(each) for each in (PARAMETER, other)] == [Quantity(3), Quantity(4)]
    assert [index(each) for each in (PARAMETER, other)] == [Quantity(2), Quantity(0)]


def test_each_parameter_and_each_place_draws_another_number() -> None:
    other = ParameterContext(1, "uavs[4].wlan[0].bitrate")
    nodes = [drawn("uniform", [plain(0), plain(1)], place) for place in range(2)]
    assert len({str(node(each)) for node in nodes for each in (PARAMETER, other)}) == 4


@pytest.mark.parametrize(
    "node", [index, index_above("parentIndex", []), drawn("uniform", [plain(0), plain(1)], 0)]
)
def test_what_needs_a_parameter_is_refused_without(node: Node) -> None:
    with pytest.raises(BadValue, match=r"is not$|knows no index$"):
        node(None)


def test_signs() -> None:
    assert signed("-", plain(3))(None) == Quantity(-3)
    assert signed("!", NO)(None) is True


def test_a_function_gets_the_values_of_its_nodes() -> None:
    assert called("max", [plain(3), index_above("parentIndex", [])])(PARAMETER) == Quantity(3)
