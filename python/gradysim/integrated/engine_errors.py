"""What the engine finds wrong with a configuration, told where the .ini file says it."""

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from gradysim.config.error import ConfigError
from gradysim.config.setting import Setting


@contextmanager
def errors_at(settings: Mapping[str, Setting]) -> Iterator[None]:
    """Turn an error of the engine's check into a ConfigError, at the setting whose field its text names."""
    try:
        yield
    except ValueError as error:  # the engine's ConfigError is one
        setting = named_in(str(error), settings)
        if setting is None:
            raise ConfigError(str(error)) from error
        raise ConfigError.at(setting.source, str(error)) from error


@contextmanager
def errors_at_line(setting: Setting) -> Iterator[None]:
    """Turn an error of the engine's check into a ConfigError at that setting."""
    try:
        yield
    except ValueError as error:
        raise ConfigError.at(setting.source, str(error)) from error


def named_in(text: str, settings: Mapping[str, Setting]) -> Setting | None:
    """Return the setting whose field is named first in `text`, or None."""
    found = {field: re.search(rf"\b{re.escape(field)}\b", text) for field in settings}
    places = {match.start(): field for field, match in found.items() if match is not None}
    return settings[places[min(places)]] if places else None
