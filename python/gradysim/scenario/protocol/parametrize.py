"""Gives a protocol class the parameters of one node."""

import types
from collections.abc import Callable, Mapping
from functools import lru_cache, partial, wraps

from gradysim.protocol.interface import IProtocol

_SUBCLASSES = "_gradysim_parametrized"


def parametrize(cls: type[IProtocol], parameters: Mapping[str, object]) -> type[IProtocol]:
    """A subclass with the parameters as class attributes, so that they hold in `__init__` already.

    It has the name of the class itself. Equal parameters give the same subclass; none give the class itself.
    """
    if not parameters:
        return cls
    if _SUBCLASSES not in vars(cls):  # kept with their class: they go together
        setattr(cls, _SUBCLASSES, lru_cache(maxsize=1024)(partial(_parametrized, cls)))
    made: type[IProtocol] = vars(cls)[_SUBCLASSES](
        tuple((name, type(value), value) for name, value in sorted(parameters.items()))
    )
    return made


def _parametrized(cls: type[IProtocol], parameters: tuple[tuple[str, type, object], ...]) -> type[IProtocol]:
    """As above. The types are part of the key since 1, 1.0 and True are equal."""
    values = {name: value for name, _, value in parameters}
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
    """A class of these bases, with the name of `cls`."""
    named = {"__module__": cls.__module__, "__qualname__": cls.__qualname__, "__doc__": cls.__doc__}
    return types.new_class(cls.__name__, bases, exec_body=lambda body: body.update({**namespace, **named}))


def _data_class_constructor(cls: type, values: Mapping[str, object]) -> Callable[..., None] | None:
    """The constructor that `@dataclass` made for `cls`, which takes `values` where it is given nothing else.

    It holds its defaults itself, so class attributes of a subclass do not change them. None if there is no
    such constructor, or none of its fields is among the values.
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
