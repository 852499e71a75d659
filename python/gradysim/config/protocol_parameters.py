"""The parameters of a protocol: its public class attributes that are plain values."""

import inspect
import re
from functools import lru_cache

from gradysim.config.kinds import Kind, boolean, integer, si_number, text
from gradysim.protocol.interface import IProtocol


def _annotations(cls: type) -> dict[str, object]:
    try:
        return dict(inspect.get_annotations(cls))
    except NameError:  # names that exist for type checkers only; Python 3.14 looks them up here
        return {}


_FLOAT = si_number()
_INTEGER = integer(at_most=None)
_BOOLEAN = boolean()
_TEXT = text()
_CONTRACT = {*dir(IProtocol), *_annotations(IProtocol)}
"""Names that mean something to every environment."""


@lru_cache(maxsize=1024)
def parameters_of(cls: type[IProtocol]) -> dict[str, Kind]:
    """Names of the parameters that can be set, each with what its value has to be: the type of its default.

    A default such as `delay: float = 0` is a float.
    """
    parameters: dict[str, Kind] = {}
    for base in reversed(cls.__mro__):
        if base in IProtocol.__mro__:
            continue
        annotations = _annotations(base)
        for name, default in vars(base).items():
            if name.startswith("_") or name in _CONTRACT:
                continue
            kind = _kind_of(default, annotations.get(name))
            if kind is not None:
                parameters[name] = kind
            else:
                parameters.pop(name, None)
    return parameters


def _kind_of(default: object, annotation: object) -> Kind | None:
    if type(default) is bool:
        return _BOOLEAN
    if type(default) is float or (type(default) is int and _mentions_float(annotation)):
        return _FLOAT
    if type(default) is int:
        return _INTEGER
    return _TEXT if type(default) is str else None


def _mentions_float(annotation: object) -> bool:
    text_of_it = annotation.__name__ if isinstance(annotation, type) else str(annotation)
    return re.search(r"\bfloat\b", text_of_it) is not None
