"""Native protocols, which the compiled engine implements: `protocol.typename` names them.

A scenario has a class for each, made from the engine's table, so that its parameters are read and listed like
those of other protocols. The class itself runs nothing.
"""

import importlib
import importlib.util
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, NoReturn

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import BadValue, nearest

if TYPE_CHECKING:
    from gradysim import _netsim


@dataclass(frozen=True)
class NativeParameter:
    """What the class attribute of a parameter does not tell: its unit, "" for none, and its meaning."""

    unit: str
    meaning: str


class NativeProtocol(IProtocol):
    """A protocol of the engine. The public class attributes of a subclass are its parameters."""

    _meaning: ClassVar[str] = ""
    _python_class: ClassVar[str] = ""
    """The class in examples/ that does the same, as "file.py:Class", or ""."""
    _parameters: ClassVar[Mapping[str, NativeParameter]] = {}

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        """Raise RuntimeError, as all callbacks do."""
        raise RuntimeError(text_of_only_integrated(type(self), "here"))

    initialize = handle_timer = handle_packet = handle_telemetry = finish = _refuse


def text_of_only_integrated(cls: type[NativeProtocol], mode: str) -> str:
    """Return the message that a native protocol does not run in `mode`, with what to use instead."""
    twin = f'; use `protocol.class` with "{cls._python_class}" of gradysim\'s sources instead, or'
    hint = twin if cls._python_class else "; use"
    return f"the native protocol {cls.__name__} does not run in {mode}{hint} integrated mode"


@cache
def native_protocols() -> Mapping[str, type[NativeProtocol]]:
    """Return all native protocols by name.

    Raises:
        ImportError: The engine has not been built.
    """
    return {
        row.name: _class_of(row) for row in importlib.import_module("gradysim._netsim").native_protocols()
    }


def _class_of(row: "_netsim.NativeProtocol") -> type[NativeProtocol]:
    parameters = {each.name: NativeParameter(each.unit, each.meaning) for each in row.parameters}
    attributes = {
        "__module__": __name__,
        "__doc__": row.meaning,
        "_meaning": row.meaning,
        "_python_class": row.python_class,
        "_parameters": parameters,
        **{each.name: each.default for each in row.parameters},
    }
    return type(row.name, (NativeProtocol,), attributes)


def __getattr__(name: str) -> type[NativeProtocol]:
    """Return the class of a native protocol: pickle looks for it in the module."""
    if not name.startswith("_") and is_native_name(name):
        return native_protocols()[name]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def native_protocol(name: str) -> type[NativeProtocol]:
    """Return the native protocol of that name.

    Raises:
        BadValue: There is none, or the engine has not been built.
    """
    try:
        table = native_protocols()
    except ImportError as error:
        problem = f"native protocols need the compiled part of gradysim, which cannot be imported ({error})"
        raise BadValue(problem) from error
    if name not in table:
        meant = "protocol.class" if ":" in name else nearest(name, table)
        raise BadValue(f"there is no native protocol `{name}`", suggestion=meant)
    return table[name]


def is_native_name(name: str) -> bool:
    """Return whether there is a native protocol of that name. There are none without the engine."""
    try:
        return name in native_protocols()
    except ImportError:
        return False


def file_of_native(protocols: Iterable[type[IProtocol]]) -> dict[str, Path]:
    """Return {name in results: the engine's file} if one of the protocols is native, otherwise {}."""
    if not any(issubclass(cls, NativeProtocol) for cls in protocols):
        return {}
    engine = importlib.util.find_spec("gradysim._netsim")
    return {"gradysim/_netsim": Path(engine.origin)} if engine is not None and engine.origin else {}
