"""The engine's fields and SI units in the terms of an .ini file: its keys, and the units that people write.

The engine's errors say `radio.energy_detection_w = 3.16e-12 W: expected more than ...`; who wrote the file
knows `energyDetection` and -85dBm.
"""

import re
from collections.abc import Mapping
from functools import cache

from gradysim.scenario.keys import NETWORK_KEYS, NODE_KEYS
from gradysim.scenario.keys.interface import written_for
from gradysim.scenario.keys.key import Key
from gradysim.scenario.units import UNITS

FIELD = re.compile(
    r"(?P<interface>\bwlan\[\d+\]\.)?\b(?P<target>"
    r"(?:medium|node|mobility|interface|radio|antenna|mac|csma|protocol)\.[A-Za-z_]\w*)\b"
)
"""A field as the engine names it: its target, and the interface that it is of if there are several."""

_NUMBER = r"-?(?:\d+(?:\.\d+)?(?:e[-+]?\d+)?|inf)"
_QUANTITY = re.compile(rf"(?<![\w.])({_NUMBER}) (W|Hz|m/s|m|s|rad|bps|B|K|dB)\b")
_BARE = re.compile(rf"(?<![\w.\[\"])({_NUMBER})(?![\w.\]\"])")
_UNREADABLE = re.compile(r"\de[-+]|-inf|^-?0\.00")
_STEPS = {
    "W": ("GW", "MW", "W", "mW", "uW", "nW", "pW", "fW"),
    "Hz": ("GHz", "MHz", "kHz", "Hz"),
    "s": ("s", "ms", "us", "ns", "ps"),
    "m": ("km", "m", "mm"),
    "bps": ("Mbps", "kbps", "bps"),
}


@cache
def keys_by_target() -> Mapping[str, Key]:
    """Return the key of each field. Of several, the last one has the field's own unit."""
    return {key.target: key for key in (*NETWORK_KEYS, *NODE_KEYS)}


def key_name(field: re.Match[str]) -> str:
    """Return how an .ini file calls a field; the engine's name if no key sets it."""
    key = keys_by_target().get(field["target"])
    return written_for(key.written, field["interface"] or "") if key else field["target"]


def in_ini_terms(text: str, target: str = "") -> str:
    """Return a text of the engine about the field `target`, as the reader of the .ini file would say it."""
    key = keys_by_target().get(target)
    if key is not None and key.kind.unit == "dB" and not target.endswith("_db"):
        text = _BARE.sub(lambda match: _ratio(float(match[1]), key), text)
    text = _QUANTITY.sub(lambda match: _quantity(float(match[1]), match[2], key), text)
    return FIELD.sub(key_name, text)


def _ratio(number: float, key: Key) -> str:
    return key.kind.show(number) if number > 0 else f"{number:g}"


def _quantity(number: float, unit: str, key: Key | None) -> str:
    unit = "mps" if unit == "m/s" else unit
    shown = UNITS.get(key.kind.unit) if key else None
    if key is not None and shown is not None and shown.dimension is UNITS[unit].dimension:
        text = key.kind.show(number)
        if not _UNREADABLE.search(text):
            return text
    return _readable(number, unit)


def _readable(number: float, unit: str) -> str:
    """In the largest unit of which it is at least one."""
    for name in _STEPS.get(unit, ()):
        in_that = number / float(UNITS[name].factor)
        if abs(in_that) >= 1:
            return f"{in_that:.6g}{name}"
    return f"{number:.6g}{unit}"
