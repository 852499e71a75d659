"""Gives a protocol class the parameters of one node."""

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

    return types.new_class(cls.__name__, (cls,), exec_body=fill)
