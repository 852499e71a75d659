"""Replaces the names of nodes by their ids, in the parameters of protocols that are about nodes."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from gradysim.omnetpp_import.defaults import translated_lines
from gradysim.omnetpp_import.outcome import Action, Outcome, not_modelled
from gradysim.scenario.errors import ErrorCollector
from gradysim.scenario.parse.ini import Entry, Section
from gradysim.scenario.resolve.groups import find_groups
from gradysim.scenario.resolve.lines import Lines
from gradysim.scenario.schema.values import SettingReader

_DESTINATIONS, _HEARS = ".protocol.destinations", ".protocol.hears"


def name_by_ids(by_section: Mapping[str, list[Outcome]], orders: Iterable[Sequence[Section]]) -> None:
    """Replace the names of nodes in the lines of all sections.

    Lines are left to the user if the names have different ids in different runs.

    Args:
        by_section: What was done with the lines of each section, which this changes.
        orders: The sections of each configuration in search order.
    """
    ids: dict[str, list[dict[str, int]]] = {
        name: [] for name, outcomes in by_section.items() if any(map(_names_nodes, outcomes))
    }
    for order in orders:
        if ids.keys().isdisjoint(section.name for section in order):
            continue
        of_config = _ids(
            [
                replace(line, rank=rank)
                for rank, section in enumerate(order, 1)
                for line in translated_lines(by_section[section.name])
            ]
        )
        for section in order:
            if section.name in ids:
                ids[section.name].append(of_config)
    for name, known in ids.items():
        outcomes = by_section[name]
        for index, outcome in enumerate(outcomes):
            key, _, text = outcome.text.partition(" = ")
            if outcome.entry and _names_nodes(outcome):
                if numbers := _with_ids(text, known):
                    outcomes[index] = replace(outcome, text=f"{key} = {numbers}")
                elif key.endswith(_HEARS):
                    outcomes[index] = not_modelled(outcome.entry, "messages of all nodes count")
                else:
                    note = f"ids of {text}"
                    outcomes[index] = replace(outcome, action=Action.TO_WRITE, text=f"{key} = ...", note=note)


def _names_nodes(outcome: Outcome) -> bool:
    """Return whether a line here has names of nodes."""
    return outcome.is_in_force and outcome.text.partition(" = ")[0].endswith((_DESTINATIONS, _HEARS))


def _ids(lines: Sequence[Entry]) -> dict[str, int]:
    """Return {name: id} of the nodes of a configuration.

    Nodes are left out behind a group whose size differs between runs, as their ids differ, too.
    """
    ids: dict[str, int] = {}
    for group in find_groups(Lines(lines), SettingReader(), ErrorCollector()):
        if group.has_wrong_size:
            break
        for name in group.node_names():
            ids[name] = len(ids)
    return ids


def _with_ids(text: str, ids: Sequence[Mapping[str, int]]) -> str:
    """Return a value with ids in place of names; "" if one is unknown, or differs between configurations."""

    def numbers(match: re.Match[str], of_config: Mapping[str, int]) -> str:
        return '"' + " ".join(str(of_config[name]) for name in match[1].split()) + '"'

    try:
        texts = {
            re.sub(r'"([^"]*)"', lambda match, known=of_config: numbers(match, known), text)  # type: ignore[misc]
            for of_config in ids
        }
    except KeyError:
        return ""
    return texts.pop() if len(texts) == 1 else ""
