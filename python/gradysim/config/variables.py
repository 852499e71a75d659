"""Replaces `${...}` in values, run by run.

This is a stage of its own between the sections and the meaning of keys: entries go in, entries come out. It
knows the predefined variables only; iteration variables (`${1s, 2s}`) are refused.
"""

import re
from collections.abc import Mapping
from dataclasses import replace

from gradysim.config.error import ConfigError
from gradysim.config.reader import Entry

_VARIABLE = re.compile(r"\$\{([^{}]*)\}")


def run_variables(config: str, run_number: int) -> dict[str, str]:
    """The predefined variables of one run. Without iteration variables each run is a repetition."""
    return {"runnumber": str(run_number), "repetition": str(run_number), "configname": config}


def substitute(entry: Entry, variables: Mapping[str, str]) -> Entry:
    """The entry with its variables replaced by their values, also inside of texts.

    Raises:
        ConfigError: A variable is none of those.
    """
    if "${" not in entry.text:
        return entry

    def value_of(match: re.Match[str]) -> str:
        name = match.group(1).strip()
        if name not in variables:
            known = " or ".join(f"`${{{known}}}`" for known in variables)
            raise ConfigError.at(
                entry.source,
                f"iteration variables (`{match.group()}`) are not supported; expected one value, or {known}",
            )
        return variables[name]

    return replace(entry, text=_VARIABLE.sub(value_of, entry.text))


def depends_on_run(entry: Entry) -> bool:
    """Whether the value differs between the runs of a configuration."""
    return any(match.group(1).strip() != "configname" for match in _VARIABLE.finditer(entry.text))
