"""Parameters of protocols: public class attributes that are plain values, their units, and setting them."""

import inspect
import re
import types
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, lru_cache, partial, wraps
from typing import Any

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.expressions import Bracketed
from gradysim.scenario.parse.functions import Value, text_of
from gradysim.scenario.parse.units import UNITS, UNITS_IN_NAMES, Dimension, Quantity
from gradysim.scenario.schema.native_protocols import NativeProtocol
from gradysim.scenario.schema.parameter_types import (
    ParameterType,
    Scalar,
    boolean,
    integer,
    number_in,
    si_number,
    text,
)

_MOST_CLASSES = 256
"""Classes whose parameters are cached. A script may read files again and again, each time as new classes."""


def annotations_of(cls: type) -> dict[str, object]:
    """Return the annotations of a class without those of its bases; strings where they are strings."""
    try:
        return dict(inspect.get_annotations(cls))
    except NameError:  # names that exist for type checkers only; Python 3.14 looks them up here
        return {}


_CONTRACT = {*dir(IProtocol), *annotations_of(IProtocol)}
"""Names that mean something to every environment."""


@lru_cache(maxsize=_MOST_CLASSES)
def parameters_of(cls: type[IProtocol]) -> dict[str, ParameterType]:
    """Return {name: type of its values} for the parameters of a protocol.

    The type is that of the default; `delay: float = 0` is a float, too. `read_scalar` in lookup.py converts
    quantities by it, to the unit of the parameter, or to SI units if nothing declares it. An angle needs a
    declared unit.
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
    """Return whether scripts may set an attribute of a protocol: one that it has or declares, of any type."""
    return name not in _CONTRACT and (
        hasattr(cls, name) or any(name in annotations_of(base) for base in cls.__mro__)
    )


_BY_END = {name.lower(): name for name in UNITS_IN_NAMES}

_ANNOTATED = re.compile(r"""\bAnnotated\[[^"']*, *["'](\w+)["']""")
"""In the text of an annotation, which may be a string."""


def unit_of(cls: type[IProtocol], name: str) -> str | None:
    """Return the name of the unit of a parameter; None if nothing declares it.

    The engine declares those of native protocols. A class in Python declares it by an annotation, as in
    `interval: Annotated[float, "s"] = 5.0`, or by the end of the name, as in `timeout_ms`. Ends that often
    mean something else do not count: `vector_x`, `point_a`, `size_b`, `rician_k`.
    """
    if issubclass(cls, NativeProtocol):
        declared = cls._parameters.get(name)
        return declared.unit if declared is not None and declared.unit in UNITS else None
    for base in cls.__mro__:
        if name in (annotations := annotations_of(base)):
            annotated = _ANNOTATED.search(str(annotations[name]))
            if annotated and annotated[1] in UNITS:
                return annotated[1]
            break
    _, underscore, end = name.rpartition("_")
    return _BY_END.get(end) if underscore else None


_BOOLEAN = boolean()
_TEXT = text()


def _kind_of(cls: type[IProtocol], name: str, default: object, annotation: object) -> ParameterType | None:
    annotated = annotation.__name__ if isinstance(annotation, type) else str(annotation)
    is_float = re.search(r"\bfloat\b", annotated) is not None
    unit = unit_of(cls, name)
    if type(default) is bool:
        return _BOOLEAN
    if type(default) is float or (type(default) is int and is_float):
        return _float_without_unit(name) if unit is None else number_in(unit)
    if type(default) is int:
        return _integer_of(name, default, unit, is_native=issubclass(cls, NativeProtocol))
    for kind in (list, tuple):
        if type(default) is kind:
            return _list_of(name, kind, unit, is_float)
    return _TEXT if type(default) is str else None


_LISTS: dict[object, str] = {list: "a list such as [1, 2]", tuple: "a tuple such as (1, 2)"}


@cache
def _list_of(name: str, kind: Callable[..., Any], unit: str | None, is_float: bool) -> ParameterType:
    """Take lists or tuples. Numbers are floats if the annotation has `float`, or else as they are written."""
    number = _float_without_unit(name) if unit is None else number_in(unit)

    def convert(value: Any) -> Any:
        if not isinstance(value, tuple):
            raise BadValue(f"`{text_of(value)}` is a single value")
        items = tuple(map(element, value))
        return Bracketed(items) if kind is list else items

    def element(value: Any) -> Any:
        if isinstance(value, tuple):
            return type(value)(map(element, value))
        if not isinstance(value, Quantity):
            return value
        if unit is None and value.unit is None and not is_float and isinstance(value.number, int):
            return value.number
        return number.convert(value)

    return ParameterType(_LISTS[kind], convert, is_list=True)


def _as_written(value: Any) -> Any:
    """Return a value with lists instead of `Bracketed`."""
    if isinstance(value, Bracketed):
        return list(map(_as_written, value))
    return tuple(map(_as_written, value)) if isinstance(value, tuple) else value


def _types_in(value: Any) -> Any:
    return (type(value), *map(_types_in, value)) if isinstance(value, tuple) else type(value)


@cache
def _float_without_unit(name: str) -> ParameterType:
    """Take any number but an angle: commands want degrees, and the SI unit is the radian."""
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
    number = "an integer" if unit is None else f"an integer number of {unit}"
    any_integer = integer(at_most=None)

    def convert(value: Value) -> Scalar:
        try:
            return any_integer.convert(value if unit is None else _without_unit(value, unit))
        except BadValue as error:
            if isinstance(value, Quantity) and not (error.suggestion or error.hint) and not is_native:
                hint = f"; for other numbers write `{name}: float = {default}` in the class"
                raise BadValue(error.problem, hint) from None
            raise

    return replace(any_integer, convert=convert, expected=f"{number}, as the parameter is an int")


def _without_unit(value: Value, unit: str) -> Value:
    """Return a quantity as a plain number of `unit`."""
    if not isinstance(value, Quantity) or value.unit is None:
        return value
    number = float(number_in(unit).convert(value))
    if not number.is_integer():
        raise BadValue(f"`{value}` is not an integer number of {unit}")
    return Quantity(int(number))


_SUBCLASSES = "_gradysim_parametrized"


def parametrize(cls: type[IProtocol], parameters: Mapping[str, object]) -> type[IProtocol]:
    """Return a subclass with the parameters as class attributes, so that `__init__` can read them.

    It has the name of the class itself. Equal parameters return the same subclass, none the class itself.
    """
    if not parameters:
        return cls
    if _SUBCLASSES not in vars(cls):  # stored in their class, so that they are freed together
        setattr(cls, _SUBCLASSES, lru_cache(maxsize=1024)(partial(_parametrized, cls)))
    subclass: type[IProtocol] = vars(cls)[_SUBCLASSES](
        tuple((name, _types_in(value), value) for name, value in sorted(parameters.items()))
    )
    return subclass


def _parametrized(
    cls: type[IProtocol], parameters: tuple[tuple[str, object, object], ...]
) -> type[IProtocol]:
    """Make the subclass. The types are part of the cache's key, since 1, 1.0 and True are equal."""
    values = {name: _as_written(value) for name, _, value in parameters}
    constructors = {
        base: constructor
        for base in cls.__mro__
        if (constructor := _data_class_constructor(base, values)) is not None
    }
    # That of a base comes before the base itself in the method resolution order: super().__init__() finds it.
    others = [
        _subclass(base, (base,), {"__init__": constructor})
        for base, constructor in constructors.items()
        if base is not cls
    ]
    own = {"__init__": constructors[cls]} if cls in constructors else {}
    subclass: type[IProtocol] = _subclass(cls, (cls, *others), {**values, **own})
    return subclass


def _subclass(cls: type, bases: tuple[type, ...], namespace: Mapping[str, object]) -> type:
    """Return a class with these bases and the name of `cls`."""
    named = {"__module__": cls.__module__, "__qualname__": cls.__qualname__, "__doc__": cls.__doc__}
    return types.new_class(cls.__name__, bases, exec_body=lambda body: body.update({**namespace, **named}))


def _data_class_constructor(cls: type, values: Mapping[str, object]) -> Callable[..., None] | None:
    """Return the constructor that `@dataclass` made for `cls`, with `values` as defaults.

    The original holds its defaults itself: class attributes of a subclass do not change them. None if there
    is no such constructor, or if none of its fields is among the values.
    """
    made = vars(cls).get("__init__")
    if "__dataclass_params__" not in vars(cls) or not isinstance(made, types.FunctionType):
        return None
    code = made.__code__
    names = code.co_varnames[1 : code.co_argcount + code.co_kwonlyargcount]
    is_written_out = not set(names) <= vars(cls)["__dataclass_fields__"].keys()
    if is_written_out or not values.keys() & set(names):
        return None

    @wraps(made)
    def constructor(self: object, *by_position: object, **by_name: object) -> None:
        others = names[len(by_position) :]
        made(self, *by_position, **{name: values[name] for name in others if name in values} | by_name)

    return constructor
