"""Reads the text of a value: quantities with units, texts in quotes, true and false, and expressions of them.

Its grammar, OMNeT++'s but for operators of bits, and functions of texts, files and units:

- value = operation ["?" value ":" value]
- operation = power (operator power)*, by the levels of operators.OPERATORS
- power = signed ["^" power]
- signed = ("-" | "+" | "!") signed | term
- term = quantity+ | text | "true" | "false" | "(" value ")" | call | "index"
- call = function "(" [value ("," value)*] ")", of functions, drawing_functions and parameter_context
- quantity = number [unit]; several of different units stand for their sum, as in `1h 5min`

A text is read once, into a function of the parameter that it is for, and worked out for each of them. What
`?`, `&&`, `||` and `select` leave aside has to be well written but needs no value: `${n} > 0 ? 1 / ${n} : 1`.
"""

import math
import re
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from functools import lru_cache

from gradysim.scenario.errors import BadValue, nearest
from gradysim.scenario.value.drawing_functions import DRAWING_FUNCTIONS
from gradysim.scenario.value.expression_tree import (
    Node,
    called,
    chain,
    choice,
    constant,
    drawn,
    index,
    index_above,
    raised,
    selection,
    signed,
)
from gradysim.scenario.value.functions import FUNCTIONS, SELECT
from gradysim.scenario.value.operators import OPERATORS, Value
from gradysim.scenario.value.parameter_context import INDEX, INDEX_FUNCTIONS, ParameterContext
from gradysim.scenario.value.quantity import Number, Quantity
from gradysim.scenario.value.quoted import QUOTED, unquoted
from gradysim.scenario.value.stray_token import is_operator_of_python, not_understood
from gradysim.scenario.value.units import unit_named

_TOKENS = re.compile(
    rf"""\s*(?:
      (?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)
    | (?P<text>{QUOTED})
    | (?P<word>[A-Za-z_]+(?:\d+(?=\s*\())?)
    | (?P<sign>&&|\|\||==|!=|<=|>=|=~|[-+*/%^(),?:!<>])
    | (?P<other>\S)
    )""",
    re.VERBOSE | re.ASCII | re.DOTALL,
)
_SPEEDS = {"m/s": "mps", "km/h": "kmph", "km/s": "kmps"}
"""Units as people write them, and their names here."""
_WORDS = ("true", "false", "inf", "nan")
_FUNCTION_NAMES = (*FUNCTIONS, SELECT, *DRAWING_FUNCTIONS, *INDEX_FUNCTIONS)
_MAX_DEPTH = 50
_MAX_DIGITS = 300


def parse_value(text: str, parameter: ParameterContext | None = None) -> Value:
    """The value of a text such as `1h 5min`, `-85dBm`, `2 * 50m`, `"g(mixed)"` or `true`.

    With the `parameter` that it is for, it may be drawn and depend on indices: `uniform(0m, 1km)`,
    `50m * parentIndex()`.

    Raises:
        BadValue: It is none.
    """
    return _read(text)(parameter)


@lru_cache(maxsize=1024)
def _read(text: str) -> Node:
    return _Parser(text).parse()


class _Parser:
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
            raise not_understood(token, self._text)
        return node

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
            node = self._operation()
            if not self._accept("?"):
                return choice(choices, node) if choices else node
            with self._deeper():
                choices.append((node, self._value()))
            if not self._accept(":"):
                raise BadValue("`?` is without its `:`")

    def _operation(self, least_level: int = 0) -> Node:
        first = self._power()
        rest: list[tuple[str, Node]] = []
        while True:
            kind, sign = self._peek()
            if kind != "sign" or sign not in OPERATORS or OPERATORS[sign].level < least_level:
                return chain(first, rest) if rest else first
            self._position += 1
            rest.append((sign, self._operation(OPERATORS[sign].level + 1)))

    def _power(self) -> Node:
        base = self._signed()
        if not self._accept("^"):
            return base
        with self._deeper():
            exponent = self._power()
        return raised(base, exponent)

    def _signed(self) -> Node:
        sign = self._accept("+", "-", "!")
        if not sign:
            return self._term()
        with self._deeper():
            operand = self._signed()
        return signed(sign, operand)

    def _term(self) -> Node:
        kind, token = self._peek()
        self._position += 1
        if kind == "text":
            return constant(unquoted(token))
        if kind == "number" or token in ("inf", "nan"):
            self._position -= 1
            return constant(self._quantities())
        if token in ("true", "false"):
            return constant(token == "true")
        if kind == "sign" and token == "(":
            with self._deeper():
                node = self._value()
            self._close()
            return node
        if kind == "word":
            if self._accept("("):
                return self._call(token)
            if is_operator_of_python(token):
                raise not_understood(token, self._text)
            if token == INDEX:
                return index
            raise BadValue(f"`{token}` is no value (a text stands in quotes)", self._hint_at(token))
        if kind:
            raise not_understood(token, self._text)
        is_share = self._text.rstrip().endswith("%")
        raise BadValue("the value ends too early", "; 50% is written `0.5`" if is_share else "")

    def _close(self) -> None:
        if not self._accept(")"):
            raise BadValue("`(` is not closed")

    def _call(self, name: str) -> Node:
        """The call of a function; its `(` has been read."""
        if name == INDEX:
            raise BadValue(f"`{name}` is no function", f"; did you mean `{name}`, without parentheses?")
        if name not in _FUNCTION_NAMES:
            meant = nearest(name, _FUNCTION_NAMES)
            hint = "" if meant else f"; there are {', '.join(sorted(_FUNCTION_NAMES))}"
            raise BadValue(f"there is no function `{name}`", hint, suggestion=meant)
        if name in DRAWING_FUNCTIONS:  # counted from the left, whether or not they draw
            place = self._draws
            self._draws += 1
        with self._deeper():
            nodes = self._arguments()
        if name in DRAWING_FUNCTIONS:
            return drawn(name, nodes, place)
        if name in INDEX_FUNCTIONS:
            return index_above(name, nodes)
        if name == SELECT:
            return selection(nodes)
        return called(name, nodes)

    def _arguments(self) -> list[Node]:
        if self._accept(")"):
            return []
        nodes = [self._value()]
        while self._accept(","):
            nodes.append(self._value())
        self._close()
        return nodes

    def _hint_at(self, word: str) -> str:
        if word.lower() in _WORDS:
            return f"; did you mean `{word.lower()}`?"
        if word in INDEX_FUNCTIONS:
            return f"; did you mean `{INDEX_FUNCTIONS[word]}`?"
        unit = "".join(token for _, token in self._tokens[max(0, self._position - 3) : self._position])
        return f"; did you mean `{_SPEEDS[unit]}`?" if unit in _SPEEDS else ""

    def _quantities(self) -> Quantity:
        """One quantity, or several as in `1h 5min`. Each unit stands there once: `1ms 2ms` lacks a comma."""
        total = self._quantity()
        units = {total.unit}
        while self._peek()[0] == "number":
            following = self._quantity()
            if total.unit is None or following.unit is None:
                raise BadValue(
                    f"`{following}` follows `{total}`; only quantities with units may be strung together"
                )
            if "dB" in total.unit.name or "dB" in following.unit.name:
                raise BadValue(f"`{following}` follows `{total}`; decibels cannot be strung together")
            if following.unit in units:
                raise BadValue(
                    f"`{following}` follows another number of `{following.unit.name}`",
                    "; a list of values is written `${1ms, 2ms}`",
                )
            units.add(following.unit)
            total = total.plus(following)
        return total

    def _quantity(self) -> Quantity:
        kind, token = self._peek()
        number = _parse_number(token)
        self._position += 1
        kind, token = self._peek()
        if kind != "word":
            return Quantity(number)
        if is_operator_of_python(token):
            raise not_understood(token, self._text)
        self._position += 1
        return Quantity(number, unit_named(token))


def _parse_number(token: str) -> Number:
    if token in ("inf", "nan"):
        return float(token)
    if len(token) > _MAX_DIGITS or not math.isfinite(float(token)):
        raise BadValue(f"`{token[:20]}...` is too large a number")
    if token.isdigit():
        return int(token)
    # Exponents beyond those of a double are zero, and would make an exact fraction of any size.
    return Fraction(token) if float(token) else Fraction(0)
