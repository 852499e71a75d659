"""Reads the text of a value: quantities with units, texts in quotes, true and false, and simple arithmetic.

Its grammar:

- sum = product (("+" | "-") product)*
- product = signed (("*" | "/") signed)*
- signed = "-" signed | "+" signed | term ["^" signed]
- term = quantity+ | text | "true" | "false" | "(" sum ")" | call
- call = function "(" [sum ("," sum)*] ")", of a function in drawing_functions
- quantity = number [unit]; several of different units stand for their sum, as in `1h 5min`
"""

import math
import re
from fractions import Fraction

from gradysim.config.errors.config_error import BadValue
from gradysim.config.value.drawing_functions import check_function, draw
from gradysim.config.value.parameter_stream import ParameterDraws
from gradysim.config.value.quantity import Number, Quantity
from gradysim.config.value.stray_token import not_understood
from gradysim.config.value.units import unit_named

Value = Quantity | str | bool

_TOKENS = re.compile(
    r"""\s*(?:
      (?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)
    | (?P<text>"(?:[^"\\]|\\.)*")
    | (?P<word>[A-Za-z_%]+)
    | (?P<sign>[-+*/^(),])
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


def parse_value(text: str, draws: ParameterDraws | None = None) -> Value:
    """The value of a text such as `1h 5min`, `-85dBm`, `2 * 50m`, `"g(mixed)"` or `true`.

    With `draws`, those of the parameter that it is for, it may be drawn: `uniform(0m, 1km)`.

    Raises:
        BadValue: It is none.
    """
    return _Parser(text, draws).parse()


class _Parser:
    def __init__(self, text: str, draws: ParameterDraws | None) -> None:
        self._draws = draws
        self._tokens = [
            (match.lastgroup or "", match[match.lastgroup or 0]) for match in _TOKENS.finditer(text)
        ]
        self._text = text
        self._position = 0
        self._depth = 0

    def parse(self) -> Value:
        value = self._sum()
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

    def _sum(self) -> Value:
        value = self._product()
        while sign := self._accept("+", "-"):
            value = _number(value).plus(_number(self._product()), -1 if sign == "-" else 1)
        return value

    def _product(self) -> Value:
        value = self._signed()
        while sign := self._accept("*", "/"):
            left, right = _number(value), _number(self._signed())
            value = left.times(right) if sign == "*" else left.over(right)
        return value

    def _signed(self) -> Value:
        self._depth += 1
        if self._depth > _MAX_DEPTH:
            raise BadValue("the expression is nested too deeply")
        if sign := self._accept("+", "-"):
            operand = _number(self._signed())
            value: Value = Quantity(-operand.number, operand.unit) if sign == "-" else operand
        else:
            value = self._term()
            if self._accept("^"):
                value = _number(value).power(_number(self._signed()))
        self._depth -= 1
        return value

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
        if token == "(":
            value = self._sum()
            if not self._accept(")"):
                raise BadValue("`(` is not closed")
            return value
        if kind == "word":
            if self._accept("("):
                return self._call(token)
            raise BadValue(f"`{token}` is no value (a text stands in quotes)", self._hint_at(token))
        raise not_understood(token, self._text) if kind else BadValue("the value ends too early")

    def _call(self, name: str) -> Quantity:
        """What the function draws; its `(` has been read."""
        check_function(name)
        if self._draws is None:
            raise BadValue(f"`{name}` draws the value of a parameter, which this is not")
        stream = self._draws.next_stream()
        values: list[Quantity] = []
        while not self._accept(")"):
            if values and not self._accept(","):
                raise BadValue("`(` is not closed")
            value = self._sum()
            if not isinstance(value, Quantity):
                raise BadValue(f"`{name}` takes numbers only")
            values.append(value)
        return draw(name, values, stream)

    def _hint_at(self, word: str) -> str:
        if word.lower() in _WORDS:
            return f"; did you mean `{word.lower()}`?"
        if word == "index":
            return "; no value knows the index of a node: `lineStepX = 3m` sets nodes in a line"
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
        self._position += 1
        return Quantity(number, unit_named(token))


def _number(value: Value) -> Quantity:
    if not isinstance(value, Quantity):
        raise BadValue("arithmetic is for numbers only")
    return value


def _parse_number(token: str) -> Number:
    if token in ("inf", "nan"):
        return float(token)
    if len(token) > _MAX_DIGITS or not math.isfinite(float(token)):
        raise BadValue(f"`{token[:20]}...` is too large a number")
    if token.isdigit():
        return int(token)
    # Exponents beyond those of a double are zero, and would make an exact fraction of any size.
    return Fraction(token) if float(token) else Fraction(0)
