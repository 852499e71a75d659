"""Iteration variables that nothing reads: those of a line that another one overrides by another key.

`**.rtsThreshold = ${rts=3000B, 100B}` below `**.mac.dcf.rtsPolicy.rtsThreshold = 100B` makes runs of both
values, and these are alike. Of lines with the very same key, `name_iterations` leaves the second one out.
"""

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from gradysim.scenario.errors import Source
from gradysim.scenario.ini import Entry
from gradysim.scenario.keys import NETWORK_MODULES
from gradysim.scenario.lookup import Lookup, is_ignored, is_option
from gradysim.scenario.runs.iterations import IterationVariable
from gradysim.scenario.runs.settings_hash import OF_NO_RUN

_NAMES = re.compile(r"\$\{(\w+)\}", re.ASCII)
_OF_ALL = {"iterationvars", "iterationvarsf", "iterationvarsd", "experiment", "measurement", "replication"}
"""Variables in which the values of others may be."""


@dataclass(frozen=True)
class UnreadVariables:
    """The variables of one line that no run reads.

    Attributes:
        source: The line.
        names: Those of its variables that no other line refers to, either.
        instead: A line that is in force for a parameter that this one fits, if one was found.
    """

    source: Source
    names: tuple[str, ...]
    instead: Source | None = None


def unread_variables(
    lines: Sequence[Entry], variables: Sequence[IterationVariable], read: Collection[Source]
) -> dict[Source, tuple[str, ...]]:
    """Return the lines that iterate over several values in vain, with the names of these variables.

    `lines` have names for values, and `read` are the places of those that some run reads, without options.
    """
    by_name = {variable.name: variable for variable in variables}
    used = {
        name
        for line in lines
        if line.source in read or (is_option(line) and not is_ignored(line) and line.key not in OF_NO_RUN)
        for name in _NAMES.findall(line.text)
    }
    if used & _OF_ALL:
        return {}
    for variable in variables:  # those that the ones in use are in lock-step with
        leader = variable
        while leader.name in used and leader.follows in by_name and leader.follows not in used:
            leader = by_name[leader.follows]
            used.add(leader.name)
    options = {line.source for line in lines if is_option(line)}
    unread: dict[Source, tuple[str, ...]] = {}
    for variable in variables:
        if variable.name not in used and variable.source not in options and len(variable.values) > 1:
            unread[variable.source] = (*unread.get(variable.source, ()), variable.name)
    return unread


def line_instead(
    idle: Source, lookup: Lookup, nodes: Iterable[str], parameters: Iterable[str]
) -> Source | None:
    """Return a line that is in force where the line `idle` fits, too; None if none is found.

    `nodes` are their names, `parameters` those that are read below them or below parts of the network.
    """
    found = next((found for found in lookup.found if found.entry.source == idle), None)
    if found is None:
        return None
    for parameter in filter(found.may_end_in, sorted(parameters)):
        for name in (*nodes, *NETWORK_MODULES):
            if found.pattern.matches(f"{lookup.network}.{name}.{parameter}"):
                first = lookup.first(name, parameter)
                if first is not None and first.entry.source != idle:
                    return first.entry.source
    return None
