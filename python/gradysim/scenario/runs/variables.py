"""Replaces `${...}` in values, run by run.

This is a stage of its own between the sections and the meaning of keys: entries go in, entries come out. The
stage before it, `iterations`, has left nothing but names between the braces.
"""

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from gradysim.scenario.errors import ConfigError
from gradysim.scenario.ini import Entry, Ranked
from gradysim.scenario.lookup import is_ignored
from gradysim.scenario.runs.iterations import file_names_of_iterations, text_of_iterations

_VARIABLE = re.compile(r"\$\{([^{}]*)\}")

_SAME_IN_ALL_RUNS = ("configname", "inifile", "network")


def run_variables(
    file: Path, network: str, config: str, run_number: int, repetition: int, iterations: Mapping[str, str]
) -> dict[str, str]:
    """The variables of one run: the predefined ones, and those that the configuration iterates over.

    Those that follow from what the file says of seeds and labels are not among them: `with_labels` adds them.
    """
    in_one_name, in_folders = file_names_of_iterations(iterations)
    return {
        **iterations,
        "inifile": str(file),
        "network": network,
        "configname": config,
        "runnumber": str(run_number),
        "repetition": str(repetition),
        "iterationvars": text_of_iterations(iterations),
        "iterationvarsf": in_one_name,
        "iterationvarsd": in_folders,
    }


def substitute(entry: Entry, variables: Mapping[str, str]) -> Entry:
    """The entry with its variables replaced by their values, also inside of texts.

    Raises ConfigError for one that follows from this very entry.
    """
    if "${" not in entry.text:
        return entry

    def value(match: re.Match[str]) -> str:
        if match[1] not in variables:
            raise ConfigError.at(
                entry.source, f"`${{{match[1]}}}` follows from this value; expected one that does without it"
            )
        return variables[match[1]]

    return replace(entry, text=_VARIABLE.sub(value, entry.text))


def substituted(ranked: Iterable[Ranked], variables: Mapping[str, str]) -> list[Ranked]:
    """The entries with their variables replaced, but for OMNeT++'s own."""
    return [
        Ranked(rank, entry if is_ignored(entry) else substitute(entry, variables)) for rank, entry in ranked
    ]


def depends_on_run(entry: Entry) -> bool:
    """Whether the value differs between the runs of a configuration."""
    return any(match[1] not in _SAME_IN_ALL_RUNS for match in _VARIABLE.finditer(entry.text))
