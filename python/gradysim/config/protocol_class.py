"""Gives a protocol class the parameters of one node."""

import dataclasses
import types
from collections.abc import Mapping
from functools import lru_cache

from gradysim.protocol.interface import IProtocol


def parametrize(cls: type[IProtocol], parameters: Mapping[str, object]) -> type[IProtocol]:
    """A subclass with the parameters as class attributes, so that they hold in `__init__` already.

    It has the name of the class itself. Equal parameters give the same subclass; none give the class itself.
    """
    if not parameters:
        return cls
    return _parametrized(cls, tuple((name, type(value), value) for name, value in sorted(parameters.items())))


@lru_cache(maxsize=1024)
def _parametrized(cls: type[IProtocol], parameters: tuple[tuple[str, type, object], ...]) -> type[IProtocol]:
    """As above. The types are part of the key since 1, 1.0 and True are equal."""

    def fill(namespace: dict[str, object]) -> None:
        namespace.update({name: value for name, _, value in parameters})
        namespace.update(__module__=cls.__module__, __qualname__=cls.__qualname__, __doc__=cls.__doc__)

    subclass: type[IProtocol] = types.new_class(cls.__name__, (cls,), exec_body=fill)
    made_by = getattr(cls, "__dataclass_params__", None)
    if made_by is not None and made_by.init:
        # The constructor of a data class holds the defaults of its fields, so it has to be made again.
        subclass.__annotations__ = {
            field.name: field.type
            for field in dataclasses.fields(cls)  # type: ignore[arg-type]
            if any(field.name == name for name, _, _ in parameters)
        }
        options = {name: getattr(made_by, name) for name in ("eq", "order", "unsafe_hash", "frozen")}
        subclass = dataclasses.dataclass(**options)(subclass)
    return subclass
