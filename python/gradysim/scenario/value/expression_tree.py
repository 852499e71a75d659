"""What an expression consists of: nodes, each a function of the parameter that a value is for.

`expression` makes them of a text, once, and has them worked out for each parameter.
"""

from collections.abc import Callable, Sequence

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.drawing_functions import draw
from gradysim.scenario.value.functions import SELECT, SELECT_WRITTEN, call, place_of
from gradysim.scenario.value.operators import OPERATORS, Value, number, power, text_of, truth
from gradysim.scenario.value.parameter_context import INDEX_FUNCTIONS, ParameterContext
from gradysim.scenario.value.quantity import Quantity

Node = Callable[[ParameterContext | None], Value]
"""Gives its value, or raises BadValue; None is the parameter of a value that all nodes of a line have."""


def constant(value: Value) -> Node:
    """A value that is the same for all parameters."""
    return lambda parameter: value


def choice(choices: Sequence[tuple[Node, Node]], otherwise: Node) -> Node:
    """The value of the first condition that holds."""

    def node(parameter: ParameterContext | None) -> Value:
        for condition, value in choices:
            if truth(condition(parameter), "?"):
                return value(parameter)
        return otherwise(parameter)

    return node


def chain(first: Node, rest: Sequence[tuple[str, Node]]) -> Node:
    """Operators one after the other, each with what those before it gave as its left operand."""

    def node(parameter: ParameterContext | None) -> Value:
        value = first(parameter)
        for sign, right in rest:
            operator = OPERATORS[sign]
            if operator.decided_by is None or truth(value, sign) is not operator.decided_by:
                value = operator.apply(value, right(parameter))
        return value

    return node


def raised(base: Node, exponent: Node) -> Node:
    """One value to the power of another."""
    return lambda parameter: power(base(parameter), exponent(parameter))


def signed(sign: str, operand: Node) -> Node:
    """`-`, `+` or `!` before a value."""

    def node(parameter: ParameterContext | None) -> Value:
        value = operand(parameter)
        if sign == "!":
            return not truth(value, sign)
        quantity = number(value)
        return Quantity(-quantity.number, quantity.unit) if sign == "-" else quantity

    return node


def called(name: str, values: Sequence[Node]) -> Node:
    """A function of FUNCTIONS."""
    return lambda parameter: call(name, [value(parameter) for value in values])


def drawn(name: str, values: Sequence[Node], place: int) -> Node:
    """A function of DRAWING_FUNCTIONS, with its place among those of the whole value."""

    def node(parameter: ParameterContext | None) -> Value:
        if parameter is None:
            raise BadValue(f"`{name}` draws the value of a parameter, which this is not")
        return draw(name, [value(parameter) for value in values], parameter.stream(place))

    return node


def selection(values: Sequence[Node]) -> Node:
    """The function `select`, which works out nothing but its index and the item at that place."""
    if len(values) < 2:
        raise BadValue(f"`{SELECT_WRITTEN}` does not take {len(values)} values")
    index, *items = values

    def node(parameter: ParameterContext | None) -> Value:
        try:
            place = place_of(index(parameter), len(items))
        except BadValue as error:
            raise error.with_problem(f"`{SELECT}`: {error.problem}") from None
        return items[place](parameter)

    return node


def index_above(name: str, values: Sequence[Node]) -> Node:
    """A function of INDEX_FUNCTIONS."""
    return lambda parameter: index(parameter, _levels(name, [value(parameter) for value in values]))


def index(parameter: ParameterContext | None, levels: int = 0) -> Quantity:
    """The index of the module so many levels above that of the parameter; by default a node itself."""
    if parameter is None:
        raise BadValue("this value is the same for all nodes of the line, and knows no index")
    return Quantity(parameter.index_of_ancestor(levels))


def _levels(name: str, values: Sequence[Value]) -> int:
    """How far up a function of INDEX_FUNCTIONS looks."""
    written = INDEX_FUNCTIONS[name]
    if len(values) != (name == "ancestorIndex"):
        raise BadValue(f"`{written}` does not take {len(values)} values")
    if not values:
        return 1
    (levels,) = values
    if not (isinstance(levels, Quantity) and levels.unit is None and isinstance(levels.number, int)):
        raise BadValue(f"`{written}`: `{text_of(levels)}` is no whole number")
    return levels.number
