"""What the engine finds wrong with a configuration, told where the .ini file says it, and in its terms."""

import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from gradysim.integrated.engine_defaults import engine_defaults
from gradysim.integrated.ini_terms import FIELD, in_ini_terms, key_name, keys_by_target
from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.says_in_full import says_in_full
from gradysim.scenario.errors.sibling_files import file_meant
from gradysim.scenario.keys import NETWORK_KEYS, NODE_KEYS
from gradysim.scenario.keys.key import HAS_TO_BE_GIVEN
from gradysim.scenario.settings import Setting

_COMPARED_WITH = {
    "antenna.length_m": ("radio.carrier_hz",),
    "antenna.min_gain": ("antenna.max_gain",),
    "csma.min_be": ("csma.max_be",),
    "mac.bitrate_bps": ("mac.op_mode",),
    "mac.control_bitrate_bps": ("mac.op_mode",),
    "mac.cw_max": ("mac.cw_min", "mac.op_mode"),
    "mac.cw_min": ("mac.cw_max", "mac.op_mode"),
    "mac.initial_rate_bps": ("mac.op_mode",),
    "mac.max_increase_threshold": ("mac.increase_threshold",),
    "mac.multicast_bitrate_bps": ("mac.op_mode",),
    "radio.bandwidth_hz": ("radio.carrier_hz",),
    "radio.carrier_hz": ("node.num_wlan_interfaces", "interface.typename"),
    "radio.communication_range_m": ("medium.typename",),
    "radio.energy_detection_w": (
        "medium.background_noise_w",
        "medium.temperature_k",
        "radio.noise_figure",
        "radio.bandwidth_hz",
        "medium.background_noise",
        "interface.typename",
    ),
    "radio.error_model": ("interface.typename",),
}
"""Fields that can make the default of another field wrong, the likeliest first.

The key that chooses the field's model can, too; it is not listed here.
"""

_LITERAL = re.compile(r'[-+]?[\d.]+(?:[eE][-+]?\d+)? *[A-Za-z]*|"[^"$]*"')


class EngineError(ConfigError):
    """A mistake that the engine has found.

    Attributes:
        target: The field that it is about, "radio.carrier_hz", as keys have it; "" if the engine names none.
    """

    target: str = ""


@contextmanager
def errors_at(settings: Mapping[str, Setting]) -> Iterator[None]:
    """Turn an error of the engine's check into an EngineError in the terms of the .ini file.

    `settings` are those that the engine was given, by the targets of their keys: "radio.tx_power_w". The
    place is the line of the field that the text names; if that field has its default, the line of the setting
    that the default does not go with.
    """
    try:
        yield
    except ConfigError:
        raise  # which knows its place
    except ValueError as error:  # the engine's ConfigError is one
        raise _told(str(error), settings) from error


@contextmanager
def errors_at_line(setting: Setting, hint: str = "") -> Iterator[None]:
    """Turn an error of the engine's check into a ConfigError at that setting, with a hint at its end."""
    try:
        yield
    except ValueError as error:
        raise ConfigError.at(setting.source, in_ini_terms(str(error)) + hint) from error


def settings_by_target(struct: str, settings: Mapping[str, Setting]) -> dict[str, Setting]:
    """Return the settings of the fields of one struct as `errors_at` takes them."""
    return {f"{struct}.{field}": setting for field, setting in settings.items()}


def _told(text: str, settings: Mapping[str, Setting]) -> EngineError:
    field = FIELD.search(text)
    if field is None:
        return EngineError(text)
    named = [match["target"] for match in FIELD.finditer(text)]
    target = named[0]
    place = settings.get(_nearest(named, settings))
    value = re.match(rf'{re.escape(field[0])} = ("[^"]*"|\S+(?: [A-Za-z/]+)?): ', text)
    if value is None:
        told = in_ini_terms(text, target)
    else:
        shown, rest = (in_ini_terms(part, target) for part in (value[1], text[value.end() :]))
        if target not in settings:
            key = keys_by_target().get(target)
            has_to_be_given = key is not None and key.default == HAS_TO_BE_GIVEN
            is_what = "has to be given" if has_to_be_given else f"= {shown} (its default)"
            told = f"{key_name(field)} {is_what}: {rest}"
        else:
            is_literal = place is None or _LITERAL.fullmatch(place.source.value)
            that = "" if is_literal else f"that is {shown}: "
            told = f"{_for(field, place)}{that}{rest}{_file_meant(target, settings[target])}"
    error = EngineError(told) if place is None else EngineError.at(place.source, told)
    error.target = target
    return error


def _for(field: re.Match[str], place: Setting | None) -> str:
    """Which parameter the value is for, if the line leaves a part of its name to wildcards; else ""."""
    if place is None or "*" not in (key := place.source.key):
        return ""
    target = field["target"]
    names = [other.path for other in NODE_KEYS if other.target == target]
    names += [other.path.partition(".")[2] for other in NETWORK_KEYS if other.target == target]
    is_told = any(says_in_full(key, name) for name in names or [target])
    return "" if is_told else f"for {key_name(field)}: "


def _file_meant(target: str, setting: Setting) -> str:
    """A hint at a file beside one that is not there; "" for what is no name of a file, or of one that is."""
    key, file = keys_by_target().get(target), Path(str(setting.value))
    if key is None or not key.kind.is_file or os.path.exists(file):  # False of what no file can be called
        return ""
    written = setting.source.value.strip('"')
    return file_meant(file, (".csv", ".txt"), written if written.endswith(file.name) else "")


def _nearest(named: list[str], settings: Mapping[str, Setting]) -> str:
    """The setting to blame, of the fields that a text names and of those that decide about the first one."""
    key = keys_by_target().get(named[0])
    model = (key.read_by.chosen_by,) if key and key.read_by else ()
    of_protocol = ("protocol.",) if named[0].startswith("protocol.") else ()
    causes = (*_COMPARED_WITH.get(named[0], ()), *model, *of_protocol, "node.num_wlan_interfaces")
    candidates = (*named, *(target for target in causes if _is_read(target, settings)))
    return next((target for target in candidates if target in settings), "")


def _is_read(target: str, settings: Mapping[str, Setting]) -> bool:
    """Whether the model is chosen that reads the setting."""
    key = keys_by_target().get(target)
    if key is None or key.read_by is None:
        return True
    chooser = key.read_by.chosen_by
    struct, _, field = chooser.partition(".")
    chosen = settings[chooser].value if chooser in settings else getattr(engine_defaults()[struct][""], field)
    return chosen in key.read_by.names
