"""Replaces `${...}` in values, run by run.

This is a stage of its own between the sections and the meaning of keys: entries go in, entries come out. The
stage before it, `iterations`, has left nothing but names between the braces.
"""

import re
from collections.abc import Mapping
from dataclasses import replace

from gradysim.config.file.reader import Entry
from gradysim.config.runs.iterations import text_of_iterations

_VARIABLE = re.compile(r"\$\{([^{}]*)\}")


def run_variables(
    config: str, run_number: int, repetition: int, iterations: Mapping[str, str]
) -> dict[str, str]:
    """The variables of one run: the predefined ones, and those that the configuration iterates over."""
    return {
        **iterations,
        "runnumber": str(run_number),
        "repetition": str(repetition),
        "configname": config,
        "iterationvars": text_of_iterations(iterations),
    }


def substitute(entry: Entry, variables: Mapping[str, str]) -> Entry:
    """The entry with its variables replaced by their values, also inside of texts."""
    if "${" not in entry.text:
        return entry
    return replace(entry, text=_VARIABLE.sub(lambda match: variables[match[1]], entry.text))


def depends_on_run(entry: Entry) -> bool:
    """Whether the value differs between the runs of a configuration."""
    return any(match[1] != "configname" for match in _VARIABLE.finditer(entry.text))
