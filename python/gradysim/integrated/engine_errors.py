"""Errors of the engine in the terms of an .ini file: line, key and unit.

The engine reports field, value and expectation as data. An .ini file has `energyDetection` for
radio.energy_detection_w, and -85dBm for 3.16e-12 W.
"""

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.integrated.compiled_part import load_netsim
from gradysim.scenario.errors import ConfigError, is_fully_qualified, nearest_file
from gradysim.scenario.parse.units import UNITS
from gradysim.scenario.schema.engine_keys import HAS_TO_BE_GIVEN, Key
from gradysim.scenario.schema.keys import KEYS_BY_TARGET, NETWORK_KEYS, NODE_KEYS, written_for
from gradysim.scenario.schema.values import Setting

if TYPE_CHECKING:
    from gradysim import _netsim
    from gradysim._netsim_fields import MessagePart

_LITERAL = re.compile(r'[-+]?[\d.]+(?:[eE][-+]?\d+)? *[A-Za-z]*|"[^"$]*"')
_UNREADABLE = re.compile(r"\de[-+]|-inf|^-?0\.00")
_STEPS = {
    "W": ("GW", "MW", "W", "mW", "uW", "nW", "pW", "fW"),
    "Hz": ("GHz", "MHz", "kHz", "Hz"),
    "s": ("s", "ms", "us", "ns", "ps"),
    "m": ("km", "m", "mm"),
    "bps": ("Mbps", "kbps", "bps"),
}


class EngineError(ConfigError):
    """An error found by the engine.

    Attributes:
        target: The field, "radio.carrier_hz", as in the declarations of keys; "" if there is none.
    """

    target: str = ""


@contextmanager
def errors_at(settings: Mapping[str, Setting]) -> Iterator[None]:
    """Turn an error of the engine into an EngineError at the line that causes it.

    `settings` are the settings given to the engine, by the targets of their keys: "radio.tx_power_w". If the
    field has its default, the error points to the setting that conflicts with the default.
    """
    try:
        yield
    except load_netsim().ConfigError as error:
        raise _engine_error(error, settings) from error


def text_of(error: "_netsim.ConfigError") -> str:
    """Return the message of an error without a line, in the terms of an .ini file."""
    return _text(error.message, None, error.interface)


def settings_by_target(struct: str, settings: Mapping[str, Setting]) -> dict[str, Setting]:
    """Return the settings of the fields of one struct as `errors_at` takes them."""
    return {f"{struct}.{field}": setting for field, setting in settings.items()}


def _engine_error(error: "_netsim.ConfigError", settings: Mapping[str, Setting]) -> EngineError:
    target = error.field
    setting = settings.get(_cause(error, settings))
    if not target:
        text = text_of(error)
        return EngineError(text) if setting is None else EngineError.at(setting.source, text)
    key = KEYS_BY_TARGET.get(target)
    name = _name(target, error.interface)
    value = _text([error.value], key, error.interface)
    message = _text(error.message, key, error.interface)
    if target not in settings:
        is_missing = key is not None and key.default == HAS_TO_BE_GIVEN
        is_default = f" = {value} (its default)" if value else ""
        text = f"{name}{' has to be given' if is_missing else is_default}: {message}"
    else:
        is_literal = setting is None or _LITERAL.fullmatch(setting.source.value)
        that = "" if is_literal or not value else f"that is {value}: "
        text = f"{_for(target, name, setting)}{that}{message}{_file_meant(key, settings[target])}"
    told = EngineError(text) if setting is None else EngineError.at(setting.source, text)
    told.target = target
    return told


def _text(parts: Sequence["MessagePart"], key: Key | None, interface: int | None) -> str:
    """Return a message of the engine. Quantities have the unit of the field of `key`."""

    def text(part: "MessagePart") -> str:
        match part:
            case str():
                return part
            case (field,):
                return _name(field, interface)
            case (value, unit):
                return _quantity(value, unit, key)

    return "".join(map(text, parts))


def _name(target: str, interface: int | None) -> str:
    """Return the .ini file's name of a field; the engine's name if no key sets it."""
    key = KEYS_BY_TARGET.get(target)
    if key is None:
        return target
    return written_for(key.written, "" if interface is None else f"wlan[{interface}]")


def _quantity(value: float, unit: str, key: Key | None) -> str:
    if key is not None and key.kind.unit == "dB" and not unit:
        return key.kind.show(value) if value > 0 else f"{value:g}"
    shown = UNITS.get(key.kind.unit) if key else None
    if key is not None and shown is not None and unit and shown.dimension is UNITS[unit].dimension:
        text = key.kind.show(value)
        if not _UNREADABLE.search(text):
            return text
    for name in _STEPS.get(unit, ()):
        in_that = value / float(UNITS[name].factor)
        if abs(in_that) >= 1:
            return f"{in_that:.6g}{name}"
    return f"{value:.6g}{unit}"


def _for(target: str, name: str, setting: Setting | None) -> str:
    """Return the parameter of the value if the line has wildcards for a part of its name; else ""."""
    if setting is None or "*" not in (line := setting.source.key):
        return ""
    paths = [key.path for key in NODE_KEYS if key.target == target]
    paths += [key.path.partition(".")[2] for key in NETWORK_KEYS if key.target == target]
    is_told = any(is_fully_qualified(line, path) for path in paths or [target])
    return "" if is_told else f"for {name}: "


def _file_meant(key: Key | None, setting: Setting) -> str:
    """Return a hint at a similar file if the file is missing; else ""."""
    file = Path(str(setting.value))
    if key is None or not key.kind.is_file or os.path.exists(file):  # False if the name cannot be a file's
        return ""
    written = setting.source.value.strip('"')
    match = nearest_file(file, (".csv", ".txt"), written if written.endswith(file.name) else "")
    return f"; did you mean `{match}`?" if match else ""


def _cause(error: "_netsim.ConfigError", settings: Mapping[str, Setting]) -> str:
    """Return the setting that caused the error: of the field itself, or the likeliest of related fields."""
    named = [part[0] for part in error.message if isinstance(part, tuple) and len(part) == 1]
    if not error.field:
        return next((target for target in named if target in settings), "")
    key = KEYS_BY_TARGET.get(error.field)
    chosen_by = [key.read_by.chosen_by] if key and key.read_by else []
    of_protocol = ["protocol."] if error.field.startswith("protocol.") else []
    causes = [*error.compared_with, *chosen_by, *of_protocol, "node.num_wlan_interfaces"]
    candidates = [error.field, *named, *(target for target in causes if _is_read(target, settings))]
    return next((target for target in candidates if target in settings), "")


def _is_read(target: str, settings: Mapping[str, Setting]) -> bool:
    """Return whether the model that reads the setting is chosen."""
    key = KEYS_BY_TARGET.get(target)
    if key is None or key.read_by is None:
        return True
    chooser = key.read_by.chosen_by
    chosen = settings[chooser].value if chooser in settings else KEYS_BY_TARGET[chooser].defaults[""]
    return chosen in key.read_by.names
