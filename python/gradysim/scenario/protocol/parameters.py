"""The parameters of a protocol: its public class attributes that are plain values."""

import re
from dataclasses import replace
from functools import cache

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors.config_error import BadValue
from gradysim.scenario.functions import Value
from gradysim.scenario.parameter_types import (
    ParameterType,
    Scalar,
    boolean,
    integer,
    number_in,
    si_number,
    text,
)
from gradysim.scenario.protocol.kept_with_class import kept_with_class
from gradysim.scenario.protocol.native import NativeProtocol
from gradysim.scenario.protocol.parameter_unit import annotations_of, unit_of
from gradysim.scenario.units import Dimension, Quantity


@cache
def _float_of(name: str, unit: str | None) -> ParameterType:
    return _float_without_unit(name) if unit is None else number_in(unit)


def _float_without_unit(name: str) -> ParameterType:
    """Takes no angles: of degrees and radians either may be meant, and commands want degrees."""
    any_number = si_number()

    def convert(value: Value) -> Scalar:
        unit = value.unit if isinstance(value, Quantity) else None
        if unit is not None and unit.dimension is Dimension.ANGLE:
            problem = f"`{unit.name}` at `{name}`, which does not say what unit the protocol gets"
            raise BadValue(
                problem, expected=f"a plain number, or an attribute named `{name}_deg` or `{name}_rad`"
            )
        return any_number.convert(value)

    return replace(any_number, convert=convert)


@cache
def _integer_of(name: str, default: int, unit: str | None, is_native: bool) -> ParameterType:
    number = "a whole number" if unit is None else f"a whole number of {unit}"
    whole = integer(at_most=None)

    def convert(value: Value) -> Scalar:
        try:
            return whole.convert(value if unit is None else _without_unit(value, unit))
        except BadValue as error:
            if isinstance(value, Quantity) and not error.suggestion and not is_native:
                hint = f"; for other numbers write `{name}: float = {default}` in the class"
                raise BadValue(error.problem, hint) from None
            raise

    return replace(whole, convert=convert, expected=f"{number}, as the parameter is an int")


def _without_unit(value: Value, unit: str) -> Value:
    """A quantity as the plain number that it is in `unit`."""
    if not isinstance(value, Quantity) or value.unit is None:
        return value
    number = float(number_in(unit).convert(value))
    if not number.is_integer():
        raise BadValue(f"`{value}` is no whole number of {unit}")
    return Quantity(int(number))


_BOOLEAN = boolean()
_TEXT = text()
_CONTRACT = {*dir(IProtocol), *annotations_of(IProtocol)}
"""Names that mean something to every environment."""


@kept_with_class
def parameters_of(cls: type[IProtocol]) -> dict[str, ParameterType]:
    """Names of the parameters that can be set, each with what its value has to be: the type of its default.

    A default such as `delay: float = 0` is a float. Quantities are converted to the unit of the parameter, if
    something says it, otherwise to SI units; an angle is refused there.
    """
    parameters: dict[str, ParameterType] = {}
    for base in reversed(cls.__mro__):
        if base in IProtocol.__mro__:
            continue
        annotations = annotations_of(base)
        for name, default in vars(base).items():
            if name.startswith("_") or name in _CONTRACT:
                continue
            kind = _kind_of(cls, name, default, annotations.get(name))
            if kind is not None:
                parameters[name] = kind
            else:
                parameters.pop(name, None)
    return parameters


def can_be_set(cls: type[IProtocol], name: str) -> bool:
    """Whether scripts may set that attribute of a protocol: one that it has or declares, of any type."""
    return name not in _CONTRACT and (
        hasattr(cls, name) or any(name in annotations_of(base) for base in cls.__mro__)
    )


def _kind_of(cls: type[IProtocol], name: str, default: object, annotation: object) -> ParameterType | None:
    unit = unit_of(cls, name)
    if type(default) is bool:
        return _BOOLEAN
    if type(default) is float or (type(default) is int and _mentions_float(annotation)):
        return _float_of(name, unit)
    if type(default) is int:
        return _integer_of(name, default, unit, is_native=issubclass(cls, NativeProtocol))
    return _TEXT if type(default) is str else None


def _mentions_float(annotation: object) -> bool:
    text_of_it = annotation.__name__ if isinstance(annotation, type) else str(annotation)
    return re.search(r"\bfloat\b", text_of_it) is not None
