"""Reads values of .ini files: quantities with units, strings in quotes, true and false, and expressions.

The grammar is OMNeT++'s, without operators of bits and functions of strings, files and units:

- value = operation ["?" value ":" value]
- operation = power (operator power)*, by the levels of functions.OPERATORS
- power = signed ["^" power]
- signed = ("-" | "+" | "!") signed | term
- term = quantity+ | string | "true" | "false" | "(" value ")" | call | "index"
- call = function "(" [value ("," value)*] ")", of FUNCTIONS, DISTRIBUTIONS, `select` and INDEX_FUNCTIONS
- quantity = number [unit]; several of different units stand for their sum, as in `1h 5min`

A text is parsed once, into a function of the parameter that it is for, and evaluated for each parameter. What
`?`, `&&`, `||` and `select` skip is parsed but not evaluated: `${n} > 0 ? 1 / ${n} : 1`.
"""

import math
import re
import unicodedata
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from functools import lru_cache
from typing import Any

from gradysim.scenario.errors import BadValue, nearest
from gradysim.scenario.parse.distributions import DISTRIBUTIONS, ParameterStream, distribution_in, draw
from gradysim.scenario.parse.functions import (
    FUNCTIONS,
    OPERATORS,
    QUOTED,
    Value,
    call,
    check_count,
    integer,
    item_index,
    number,
    truth,
    unquoted,
)
from gradysim.scenario.parse.units import Number, Quantity, unit_named

INDEX = "index"
"""The index of the module that a parameter belongs to. It is not a function."""

INDEX_FUNCTIONS = {"parentIndex": "parentIndex()", "ancestorIndex": "ancestorIndex(levels)"}
"""How the functions of the modules above it are written, by name."""

SELECT, SELECT_WRITTEN = "select", "select(index, a, b, ...)"
"""The function that evaluates only the item at that index."""

_TOKENS = re.compile(
    rf"""\s*(?:
      (?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)
    | (?P<string>{QUOTED})
    | (?P<word>[A-Za-z_]+(?:\d+(?=\s*\())?)
    | (?P<sign>&&|\|\||==|!=|<=|>=|=~|[-+*/%^(),?:!<>])
    | (?P<other>\S)
    )""",
    re.VERBOSE | re.ASCII | re.DOTALL,
)
_INDEX_OR_STRING = re.compile(
    rf"{QUOTED}|(\b(?:{'|'.join(INDEX_FUNCTIONS)})\s*\(|\b{INDEX}\b)", re.ASCII | re.DOTALL
)
_INDEX_IN_PATH = re.compile(r"\[(\d+)\]$", re.ASCII)
_FUNCTION_NAMES = (*FUNCTIONS, SELECT, *DISTRIBUTIONS, *INDEX_FUNCTIONS)
_MAX_DEPTH = 50
_MAX_DIGITS = 300

_SPEEDS = {"m/s": "mps", "km/h": "kmph", "km/s": "kmps"}
"""Units as people write them, and their names here."""
_PYTHON_OPERATORS = {"and": "&&", "or": "||", "not": "!"}
_MICRO = ("\N{MICRO SIGN}", "\N{GREEK SMALL LETTER MU}")
_LIST_HINT = "; a list of values is written `${1ms, 2ms}`"


class ParameterContext:
    """The parameter that a value is evaluated for: the indices in its path, and its random numbers.

    Modules are the parts of a path before the last one: in `uavs[3].mobility.speed` the module is `mobility`,
    and its parent is `uavs[3]`, so `parentIndex()` is 3.

    Attributes:
        seed: Seed of the run.
        path: Path of the parameter, without the network.
        has_drawn: Whether the value has asked for a stream.
    """

    def __init__(self, seed: int, path: str) -> None:
        self.seed = seed
        self.path = path
        self.has_drawn = False

    def stream(self, draw_index: int) -> ParameterStream:
        """Return the stream of one of the draws in the value, counted from the left, from 0."""
        self.has_drawn = True
        return ParameterStream(self.seed, self.path, draw_index)

    def index_of_ancestor(self, levels: int) -> int:
        """Return the index of the module that many levels above the one of the parameter.

        Raises:
            BadValue: There is no such module, or it has no index.
        """
        *modules, _ = self.path.split(".")
        if not 0 <= levels < len(modules):
            problem = f"there is no module {levels} levels above `{'.'.join(modules)}`"
            raise BadValue(problem, self._index_hint(modules))
        module = modules[len(modules) - 1 - levels]
        match = _INDEX_IN_PATH.search(module)
        if match is None:
            raise BadValue(f"`{module}` in `{self.path}` has no index", self._index_hint(modules))
        return int(match[1])

    def _index_hint(self, modules: Sequence[str]) -> str:
        """How to write the indices that the path has, of the node and of its interface."""
        hints = []
        for levels, module in zip(reversed(range(len(modules))), modules, strict=True):
            if _INDEX_IN_PATH.search(module):
                written = (INDEX, "parentIndex()")[levels] if levels < 2 else f"ancestorIndex({levels})"
                hints.append(f"that of `{module}` is `{written}`")
        return f"; {', '.join(hints)}" if hints else ""


Node = Callable[[ParameterContext | None], Value]
"""Part of a parsed value. Returns its value or raises BadValue; None for a value that all nodes share."""


ListValue = Value | tuple[Any, ...]
ListNode = Callable[[ParameterContext | None], ListValue]


def parse_value(text: str, parameter: ParameterContext | None = None) -> Value:
    """Return the value of a text such as `1h 5min`, `-85dBm`, `2 * 50m`, `"g(mixed)"` or `true`.

    With the `parameter` that it is for, it may be drawn and depend on indices: `uniform(0m, 1km)`,
    `50m * parentIndex()`.

    Raises:
        BadValue: The text is not a value.
    """
    return _parse(text)(parameter)


def parse_list(text: str, parameter: ParameterContext | None = None) -> ListValue:
    """Return the value of a text such as `[1, 2]` or `[(0m, 0m), (50m, 10m)]`; see `parse_value`.

    Elements are lists in brackets, tuples in parentheses with a comma, and values. A list is a `Bracketed`
    here, because values are hashed.
    """
    return _parse_list(text)(parameter)


class Bracketed(tuple[Any, ...]):
    """Elements that were written in brackets, as in a list of Python."""

    __slots__ = ()


@lru_cache(maxsize=1024)
def differs_between_parameters(text: str) -> bool:
    """Whether a value draws or asks for an index, so that each parameter has its own."""
    return bool(distribution_in(text)) or any(match[1] for match in _INDEX_OR_STRING.finditer(text))


@lru_cache(maxsize=1024)
def _parse(text: str) -> Node:
    return _Parser(text).parse()


@lru_cache(maxsize=1024)
def _parse_list(text: str) -> Callable[[ParameterContext | None], ListValue]:
    return _Parser(text).parse_list()


class _Parser:
    """A recursive-descent parser; operators by precedence climbing, with a loop for long chains."""

    def __init__(self, text: str) -> None:
        self._tokens = [
            (match.lastgroup or "", match[match.lastgroup or 0]) for match in _TOKENS.finditer(text)
        ]
        self._text = text
        self._position = 0
        self._depth = 0
        self._draws = 0

    def parse(self) -> Node:
        node = self._value()
        kind, token = self._peek()
        if kind:
            raise self._not_understood(token)
        return node

    def parse_list(self) -> "ListNode":
        """Parse a list, or another value."""
        node = self._element()
        kind, token = self._peek()
        if kind:
            raise self._not_understood(token)
        return node

    def _element(self) -> "ListNode":
        opening = self._peek()[1]
        if opening != "[" and not (opening == "(" and self._is_tuple()):
            return self._value()
        self._position += 1
        closing = "]" if opening == "[" else ")"
        nodes: list[ListNode] = []
        with self._deeper():
            while self._peek()[1] != closing:
                nodes.append(self._element())
                if self._peek()[1] == ",":
                    self._position += 1
                elif self._peek()[1] != closing:
                    raise BadValue(f"`{opening}` is not closed")
        self._position += 1
        make = Bracketed if opening == "[" else tuple
        return lambda parameter: make(node(parameter) for node in nodes)

    def _is_tuple(self) -> bool:
        """Return whether the parentheses that open here have a comma of their own, or nothing, inside."""
        depth = 0
        for position in range(self._position, len(self._tokens)):
            token = self._tokens[position][1]
            depth += (token in ("(", "[")) - (token in (")", "]"))
            if depth == 0:
                return position == self._position + 1
            if depth == 1 and token == ",":
                return True
        return False

    def _peek(self) -> tuple[str, str]:
        return self._tokens[self._position] if self._position < len(self._tokens) else ("", "")

    def _accept(self, *signs: str) -> str:
        kind, token = self._peek()
        if kind == "sign" and token in signs:
            self._position += 1
            return token
        return ""

    @contextmanager
    def _deeper(self) -> Iterator[None]:
        self._depth += 1
        if self._depth > _MAX_DEPTH:
            raise BadValue(f"the expression is nested too deeply; expected at most {_MAX_DEPTH} levels")
        yield
        self._depth -= 1

    def _value(self) -> Node:
        choices: list[tuple[Node, Node]] = []  # along `a ? b : c ? d : e`
        while True:
            otherwise = self._operation()
            if not self._accept("?"):
                break
            with self._deeper():
                choices.append((otherwise, self._value()))
            if not self._accept(":"):
                raise BadValue("`?` is without its `:`")
        if not choices:
            return otherwise

        def chosen(parameter: ParameterContext | None) -> Value:
            for condition, value in choices:
                if truth(condition(parameter), "?"):
                    return value(parameter)
            return otherwise(parameter)

        return chosen

    def _operation(self, least_level: int = 0) -> Node:
        first = self._power()
        rest: list[tuple[str, Node]] = []
        while True:
            kind, sign = self._peek()
            if kind != "sign" or sign not in OPERATORS or OPERATORS[sign].level < least_level:
                break
            self._position += 1
            rest.append((sign, self._operation(OPERATORS[sign].level + 1)))
        if not rest:
            return first

        def result(parameter: ParameterContext | None) -> Value:
            value = first(parameter)
            for sign, right in rest:
                operator = OPERATORS[sign]
                if operator.decided_by is None or truth(value, sign) is not operator.decided_by:
                    value = operator.apply(value, right(parameter))
            return value

        return result

    def _power(self) -> Node:
        base = self._signed()
        if not self._accept("^"):
            return base
        with self._deeper():
            exponent = self._power()
        return lambda parameter: number(base(parameter)).power(number(exponent(parameter)))

    def _signed(self) -> Node:
        sign = self._accept("+", "-", "!")
        if not sign:
            return self._term()
        with self._deeper():
            operand = self._signed()

        def result(parameter: ParameterContext | None) -> Value:
            value = operand(parameter)
            if sign == "!":
                return not truth(value, sign)
            quantity = number(value)
            return Quantity(-quantity.number, quantity.unit) if sign == "-" else quantity

        return result

    def _term(self) -> Node:
        kind, token = self._peek()
        if kind == "number" or token in ("inf", "nan"):
            return _constant(self._quantities())
        self._position += 1
        if kind == "string":
            return _constant(unquoted(token))
        if token in ("true", "false"):
            return _constant(token == "true")
        if kind == "sign" and token == "(":
            with self._deeper():
                node = self._value()
            self._close()
            return node
        if kind == "word" and self._accept("("):
            return self._call(token)
        if token == INDEX:
            return _index_above(lambda parameter: 0)
        if kind == "word" and token not in _PYTHON_OPERATORS:
            raise BadValue(
                f"`{token}` is not a value (strings must be quoted)", suggestion=self._meant_by(token)
            )
        if kind:
            raise self._not_understood(token)
        is_percentage = self._text.rstrip().endswith("%")
        raise BadValue("the value ends too early", "; 50% is written `0.5`" if is_percentage else "")

    def _close(self) -> None:
        if not self._accept(")"):
            raise BadValue("`(` is not closed")

    def _call(self, name: str) -> Node:
        """The call of a function; its `(` has been read."""
        if name == INDEX:
            raise BadValue(f"`{name}` is not a function", f"; did you mean `{name}`, without parentheses?")
        if name not in _FUNCTION_NAMES:
            meant = nearest(name, _FUNCTION_NAMES)
            hint = "" if meant else f"; there are {', '.join(sorted(_FUNCTION_NAMES))}"
            raise BadValue(f"there is no function `{name}`", hint, suggestion=meant)
        draw_index = self._draws
        self._draws += name in DISTRIBUTIONS  # counted from the left, whether or not they draw
        with self._deeper():
            nodes = self._arguments()
        if name in DISTRIBUTIONS:
            return _drawn(name, nodes, draw_index)
        if name == SELECT:
            return _selected(nodes)
        if name not in INDEX_FUNCTIONS:
            return lambda parameter: call(name, [node(parameter) for node in nodes])
        check_count(INDEX_FUNCTIONS[name], len(nodes))
        return _index_above(lambda parameter: _levels(nodes[0](parameter)) if nodes else 1)

    def _arguments(self) -> list[Node]:
        if self._accept(")"):
            return []
        nodes = [self._value()]
        while self._accept(","):
            nodes.append(self._value())
        self._close()
        return nodes

    def _quantities(self) -> Quantity:
        """One quantity, or several as in `1h 5min`. Each unit stands there once: `1ms 2ms` lacks a comma."""
        total = self._quantity()
        units = {total.unit}
        while self._peek()[0] == "number":
            following = self._quantity()
            follows = f"`{following}` follows "
            if total.unit is None or following.unit is None:
                raise BadValue(f"{follows}`{total}`; only quantities with units may be strung together")
            if "dB" in total.unit.name or "dB" in following.unit.name:
                raise BadValue(f"{follows}`{total}`; decibels cannot be strung together")
            if following.unit in units:
                raise BadValue(f"{follows}another number of `{following.unit.name}`", _LIST_HINT)
            units.add(following.unit)
            total = total.plus(following)
        return total

    def _quantity(self) -> Quantity:
        amount = _number_of(self._peek()[1])
        self._position += 1
        kind, token = self._peek()
        if kind != "word":
            return Quantity(amount)
        if token in _PYTHON_OPERATORS:
            raise self._not_understood(token)
        self._position += 1
        return Quantity(amount, unit_named(token))

    def _meant_by(self, word: str) -> str:
        """What may be meant by a word that is not a value, or ""."""
        if word.lower() in ("true", "false", "inf", "nan"):
            return word.lower()
        if word in INDEX_FUNCTIONS:
            return INDEX_FUNCTIONS[word]
        unit = "".join(token for _, token in self._tokens[max(0, self._position - 3) : self._position])
        return _SPEEDS.get(unit, "")

    def _not_understood(self, token: str) -> BadValue:
        """The error about a token that has no meaning where it stands. Most come from another grammar."""
        name = ""
        if len(token) == 1 and not token.isascii():  # it may look like another one, or be invisible
            name = f" (U+{ord(token):04X}, {unicodedata.name(token, 'without a name').lower()})"
        meant = {**_PYTHON_OPERATORS, "=": "==", "&": "&&", "|": "||"}.get(token, "")
        if token == "$" and (variable := re.search(r"\$(\w+)", self._text, re.ASCII)):
            meant = f"${{{variable[1]}}}"
        problem = f"`{token}`{name} is not understood there"
        return BadValue(problem, self._syntax_hint(token), suggestion=meant)

    def _syntax_hint(self, token: str) -> str:
        text = self._text
        if token in _MICRO:
            return "; a micro is `u`, as in `us`"
        if token == "/" and "//" in text:
            return "; a comment begins with `#`"
        if token == "." and ".." in text:
            return "; a range of values is written `${1..5}ms`"
        if token == "," and re.search(r"\d,\d", text):
            return f"{_LIST_HINT}, a fraction `0.5`"
        return _LIST_HINT if token in ("{", ",", "[") else ""


def _constant(value: Value) -> Node:
    return lambda parameter: value


def _drawn(name: str, values: Sequence[Node], draw_index: int) -> Node:
    """The call of a distribution, with its index among those of the whole value."""

    def node(parameter: ParameterContext | None) -> Value:
        if parameter is None:
            raise BadValue(f"`{name}` draws the value of a parameter, which this is not")
        return draw(name, [value(parameter) for value in values], parameter.stream(draw_index))

    return node


def _selected(nodes: Sequence[Node]) -> Node:
    if len(nodes) < 2:
        raise BadValue(f"`{SELECT_WRITTEN}` takes 2 values or more, not {len(nodes)}")
    index, *items = nodes

    def node(parameter: ParameterContext | None) -> Value:
        try:
            chosen = item_index(index(parameter), len(items))
        except BadValue as error:
            raise error.with_problem(f"`{SELECT}`: {error.problem}") from None
        return items[chosen](parameter)

    return node


def _index_above(levels: Callable[[ParameterContext], int]) -> Node:
    """The index of the module that many levels above the one of the parameter."""

    def node(parameter: ParameterContext | None) -> Value:
        if parameter is None:
            raise BadValue("this value is the same for all nodes of the line, and knows no index")
        return Quantity(parameter.index_of_ancestor(levels(parameter)))

    return node


def _levels(value: Value) -> int:
    try:
        return integer(value)
    except BadValue as error:
        raise BadValue(f"`{INDEX_FUNCTIONS['ancestorIndex']}`: {error.problem}") from None


def _number_of(token: str) -> Number:
    if token in ("inf", "nan"):
        return float(token)
    if len(token) > _MAX_DIGITS or not math.isfinite(float(token)):
        raise BadValue(f"`{token[:20]}...` is too large a number")
    if token.isdigit():
        return int(token)
    # Exponents beyond those of a double are zero, and would make an exact fraction of any size.
    return Fraction(token) if float(token) else Fraction(0)
