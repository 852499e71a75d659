"""Reads the text of a value: quantities with units, texts in quotes, true and false, and expressions of them.

Its grammar, OMNeT++'s but for operators of bits, and functions of texts, files and units:

- value = operation ["?" value ":" value]
- operation = power (operator power)*, by the levels of operators.OPERATORS
- power = signed ["^" power]
- signed = ("-" | "+" | "!") signed | term
- term = quantity+ | text | "true" | "false" | "(" value ")" | call | "index"
- call = function "(" [value ("," value)*] ")", of functions, drawing_functions and parameter_context
- quantity = number [unit]; several of different units stand for their sum, as in `1h 5min`

What `?`, `&&` and `||` leave aside has to be well written, but needs no value: `${n} > 0 ? 1s / ${n} : 1s`.
"""

import math
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction

from gradysim.config.errors.config_error import BadValue
from gradysim.config.errors.nearest import did_you_mean
from gradysim.config.value.drawing_functions import DRAWING_FUNCTIONS, draw
from gradysim.config.value.functions import FUNCTIONS, call
from gradysim.config.value.operators import OPERATORS, Value, number, power, text_of, truth
from gradysim.config.value.parameter_context import INDEX, INDEX_FUNCTIONS, ParameterContext
from gradysim.config.value.quantity import Number, Quantity
from gradysim.config.value.quoted import QUOTED
from gradysim.config.value.stray_token import is_operator_of_python, not_understood
from gradysim.config.value.units import unit_named

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
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}
_SPEEDS = {"m/s": "mps", "km/h": "kmph", "km/s": "kmps"}
"""Units as people write them, and their names here."""
_WORDS = ("true", "false", "inf", "nan")
_MAX_DEPTH = 50
_MAX_DIGITS = 300
_ANYTHING = Quantity(0)
"""The value of what is read but left aside."""


def parse_value(text: str, parameter: ParameterContext | None = None) -> Value:
    """The value of a text such as `1h 5min`, `-85dBm`, `2 * 50m`, `"g(mixed)"` or `true`.

    With the `parameter` that it is for, it may be drawn and depend on indices: `uniform(0m, 1km)`,
    `50m * parentIndex()`.

    Raises:
        BadValue: It is none.
    """
    return _Parser(text, parameter).parse()


class _Parser:
    def __init__(self, text: str, parameter: ParameterContext | None) -> None:
        self._parameter = parameter
        self._tokens = [
            (match.lastgroup or "", match[match.lastgroup or 0]) for match in _TOKENS.finditer(text)
        ]
        self._text = text
        self._position = 0
        self._depth = 0
        self._leaves_aside = False

    def parse(self) -> Value:
        value = self._value()
        kind, token = self._peek()
        if kind:
            raise not_understood(token, self._text)
        return value

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

    @contextmanager
    def _aside(self, condition: bool) -> Iterator[None]:
        """What is read meanwhile gives nothing of use if the condition holds."""
        before = self._leaves_aside
        self._leaves_aside |= condition
        yield
        self._leaves_aside = before

    def _result(self, apply: Callable[..., Value], *operands: object) -> Value:
        return _ANYTHING if self._leaves_aside else apply(*operands)

    def _value(self) -> Value:
        chosen: Value | None = None
        while True:  # along `a ? b : c ? d : e`
            with self._aside(chosen is not None):
                condition = self._operation()
                if not self._accept("?"):
                    return condition if chosen is None else chosen
                holds = self._leaves_aside or truth(condition, "?")
            with self._aside(not holds or chosen is not None), self._deeper():
                value = self._value()
            if not self._accept(":"):
                raise BadValue("`?` is without its `:`")
            if holds and chosen is None:
                chosen = value

    def _operation(self, least_level: int = 0) -> Value:
        left = self._power()
        while True:
            kind, sign = self._peek()
            operator = OPERATORS.get(sign) if kind == "sign" else None
            if operator is None or operator.level < least_level:
                return left
            self._position += 1
            is_decided = (
                operator.decided_by is not None
                and not self._leaves_aside
                and truth(left, sign) is operator.decided_by
            )
            with self._aside(is_decided):
                right = self._operation(operator.level + 1)
            if not is_decided:
                left = self._result(operator.apply, left, right)

    def _power(self) -> Value:
        base = self._signed()
        if not self._accept("^"):
            return base
        with self._deeper():
            return self._result(power, base, self._power())

    def _signed(self) -> Value:
        sign = self._accept("+", "-", "!")
        if not sign:
            return self._term()
        with self._deeper():
            return self._result(_with_sign, sign, self._signed())

    def _term(self) -> Value:
        kind, token = self._peek()
        self._position += 1
        if kind == "text":
            return re.sub(
                r"\\(.)", lambda match: _ESCAPES.get(match[1], match[1]), token[1:-1], flags=re.DOTALL
            )
        if kind == "number" or token in ("inf", "nan"):
            self._position -= 1
            return self._quantities()
        if token in ("true", "false"):
            return token == "true"
        if kind == "sign" and token == "(":
            with self._deeper():
                value = self._value()
            self._close()
            return value
        if kind == "word":
            if self._accept("("):
                return self._call(token)
            if is_operator_of_python(token):
                raise not_understood(token, self._text)
            if token == INDEX:
                return self._result(lambda: self._index(0))
            raise BadValue(f"`{token}` is no value (a text stands in quotes)", self._hint_at(token))
        if kind:
            raise not_understood(token, self._text)
        is_share = self._text.rstrip().endswith("%")
        raise BadValue("the value ends too early", "; 50% is written `0.5`" if is_share else "")

    def _close(self) -> None:
        if not self._accept(")"):
            raise BadValue("`(` is not closed")

    def _call(self, name: str) -> Value:
        """What the function gives; its `(` has been read."""
        draws = name in DRAWING_FUNCTIONS
        if not (draws or name in FUNCTIONS or name in INDEX_FUNCTIONS):
            names = [*FUNCTIONS, *DRAWING_FUNCTIONS, *INDEX_FUNCTIONS]
            hint = did_you_mean(name, names) or f"; there are {', '.join(sorted(names))}"
            if name == INDEX:
                hint = f"; did you mean `{INDEX}`?"
            raise BadValue(f"there is no function `{name}`", hint)
        if draws and self._parameter is None:
            raise BadValue(f"`{name}` draws the value of a parameter, which this is not")
        stream = self._parameter.next_stream() if draws and self._parameter else None
        with self._deeper():
            values = self._arguments()
        if stream is not None:
            return self._result(draw, name, values, stream)
        if name in INDEX_FUNCTIONS:
            return self._result(lambda: self._index(_levels(name, values)))
        return self._result(call, name, values)

    def _arguments(self) -> list[Value]:
        if self._accept(")"):
            return []
        values = [self._value()]
        while self._accept(","):
            values.append(self._value())
        self._close()
        return values

    def _index(self, levels: int) -> Value:
        if self._parameter is None:
            raise BadValue("this value is the same for all nodes of the line, and knows no index")
        return Quantity(self._parameter.index_of_ancestor(levels))

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


def _with_sign(sign: str, operand: Value) -> Value:
    if sign == "!":
        return not truth(operand, sign)
    quantity = number(operand)
    return Quantity(-quantity.number, quantity.unit) if sign == "-" else quantity


def _levels(name: str, values: list[Value]) -> int:
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


def _parse_number(token: str) -> Number:
    if token in ("inf", "nan"):
        return float(token)
    if len(token) > _MAX_DIGITS or not math.isfinite(float(token)):
        raise BadValue(f"`{token[:20]}...` is too large a number")
    if token.isdigit():
        return int(token)
    # Exponents beyond those of a double are zero, and would make an exact fraction of any size.
    return Fraction(token) if float(token) else Fraction(0)
