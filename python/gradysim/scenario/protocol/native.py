"""Protocols that the compiled engine has itself, as scenarios name them: `protocol.typename`.

In a scenario such a protocol is a class as any other one, so that what reads, checks and lists parameters
need not know the difference; but nothing runs in it. Integrated mode makes these classes from the engine's
table.
"""

import importlib
import importlib.util
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.scenario.errors import BadValue, nearest

_TABLE = "gradysim.integrated.native_protocols"
"""The module with the table. Its layer is above this one, so it is imported only when a file names a native
protocol."""


@dataclass(frozen=True)
class NativeParameter:
    """What people are told of a parameter; its name, kind and default are the class attribute's."""

    unit: str
    meaning: str


class NativeProtocol(IProtocol):
    """A protocol of the engine. The public class attributes of a subclass are its parameters."""

    _meaning: ClassVar[str] = ""
    _python_class: ClassVar[str] = ""
    """The class in examples/ that does the same, as "file.py:Class", or ""."""
    _parameters: ClassVar[Mapping[str, NativeParameter]] = {}

    def initialize(self) -> None:
        """Refuse: only the engine can run it."""
        raise self._only_in_the_engine()

    def handle_timer(self, timer: str) -> None:
        """Refuse, too."""
        raise self._only_in_the_engine()

    def handle_packet(self, message: str) -> None:
        """Refuse, too."""
        raise self._only_in_the_engine()

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Refuse, too."""
        raise self._only_in_the_engine()

    def finish(self) -> None:
        """Refuse, too."""
        raise self._only_in_the_engine()

    def _only_in_the_engine(self) -> RuntimeError:
        return RuntimeError(text_of_only_integrated(type(self), "here"))


def text_of_only_integrated(cls: type[NativeProtocol], mode: str) -> str:
    """Say that a native protocol cannot run in another mode, and what to do."""
    twin = f'; use `protocol.class` with "{cls._python_class}" of gradysim\'s sources instead, or'
    hint = twin if cls._python_class else "; use"
    return f"the native protocol {cls.__name__} does not run in {mode}{hint} integrated mode"


def native_protocols() -> Mapping[str, type[NativeProtocol]]:
    """Return all native protocols by name. Raises BadValue if the engine has not been built."""
    try:
        table: Mapping[str, type[NativeProtocol]] = importlib.import_module(_TABLE).native_protocols()
    except ImportError as error:  # the compiled part's absence is one
        raise BadValue(f"native protocols are the engine's: {error}") from error
    return table


def file_of_native(protocols: Iterable[type[IProtocol]]) -> dict[str, Path]:
    """Return {name: the engine's file} if one of the protocols is native: it is what that consists of.

    The name is the same wherever gradysim is installed.
    """
    if not any(issubclass(cls, NativeProtocol) for cls in protocols):
        return {}
    engine = importlib.util.find_spec("gradysim._netsim")
    return {"gradysim/_netsim": Path(engine.origin)} if engine is not None and engine.origin else {}


def native_protocol(name: str) -> type[NativeProtocol]:
    """Return the native protocol of that name. Raises BadValue, with the nearest name, if there is none."""
    table = native_protocols()
    if name not in table:
        meant = "protocol.class" if ":" in name else nearest(name, table)
        raise BadValue(f"there is no native protocol `{name}`", suggestion=meant)
    return table[name]


def is_native_name(name: str) -> bool:
    """Whether there is a native protocol of that name; none, if the engine has not been built."""
    try:
        return name in native_protocols()
    except BadValue:
        return False
