"""Translates all configurations of an `omnetpp.ini`, and lists what was done with each of its lines."""

import os
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from gradysim.omnetpp_import.defaults import defaults_of, missing_classes, translated_lines
from gradysim.omnetpp_import.lines import Action, LineTranslator, Outcome
from gradysim.omnetpp_import.ned import NedNetwork, read_networks
from gradysim.scenario.ini import GENERAL, Entry, IniFile, read_ini
from gradysim.scenario.schema import NETWORK
from gradysim.scenario.sections import config_names, search_order
from gradysim.scenario.sweep import PREDEFINED

_DEFINED = re.compile(r"\$\{\s*([A-Za-z_]\w*)\s*=(?!=)", re.ASCII)
_USED = re.compile(r"\$\{\s*([A-Za-z_]\w*)\s*\}|!\s*([A-Za-z_]\w*)\s*\}", re.ASCII)
"""Names of iteration variables in a value, where they get their values and where they are used."""


@dataclass(frozen=True)
class Translation:
    """A translated file.

    Attributes:
        text: The file here. Lines that the user writes, and those that are not modelled, are comments in it.
        outcomes: What was done: the lines of the file in their order, then those that it lacks.
    """

    text: str
    outcomes: tuple[Outcome, ...]

    def counts(self) -> Counter[Action]:
        """Return the number of lines by what was done with them, in the order of the actions."""
        count = Counter(outcome.action for outcome in self.outcomes)
        return Counter({action: count[action] for action in Action if count[action]})


def translate(file: Path, folder: Path) -> Translation:
    """Translate a file to one that will be in `folder`. NED files are looked for next to it.

    Raises:
        ConfigError: The file cannot be read, or lines are not understood; all of them are reported.
    """
    ini = read_ini(file)
    networks = read_networks(file.parent)
    sections = list(ini.sections.values())
    entries = [entry for section in sections for entry in section.entries]
    used = {
        section.name: networks[name]
        for section in sections
        for entry in section.entries
        if entry.key == NETWORK and (name := entry.text.strip('"').rpartition(".")[2]) in networks
    }
    size_keys = {
        node.size: node.size_key
        for network in used.values()
        for node in network.nodes
        if node.size.isidentifier()
    }
    lines = LineTranslator(entries, size_keys, os.path.relpath(file.parent, folder))
    by_section = {section.name: [lines.outcome(entry) for entry in section.entries] for section in sections}
    while _leave_to_user(by_section):  # a line that is left to the user may define variables of others
        pass
    outcomes = [outcome for of_section in by_section.values() for outcome in of_section]
    added = _added(ini, used, entries, by_section)
    for name, of_section in added.items():
        by_section[name] += of_section
        outcomes += of_section
    return Translation(_text(file, ini, by_section), tuple(outcomes))


def _added(
    ini: IniFile,
    used: Mapping[str, NedNetwork],
    entries: Sequence[Entry],
    by_section: Mapping[str, Sequence[Outcome]],
) -> dict[str, list[Outcome]]:
    """Return what the file lacks, by section. `used` are the networks, by the sections that choose them."""
    added: dict[str, list[Outcome]] = {name: [] for name in ini.sections}
    lines = translated_lines(outcome for outcomes in by_section.values() for outcome in outcomes)
    is_one = len({id(network) for network in used.values()}) == 1
    for name, network in list(used.items())[: 1 if is_one else None]:
        in_force = translated_lines(by_section[GENERAL])
        if not is_one or len(used) == 1:
            in_force += translated_lines(by_section[name])
        added[GENERAL if is_one else name] += [
            *defaults_of(network, entries, lines, in_force),
            *missing_classes(network, entries, lines),
        ]
    limited = {
        name
        for name, outcomes in by_section.items()
        if any(each.is_in_force and each.text.startswith("sim-time-limit ") for each in outcomes)
    }
    if any(limited.isdisjoint(each.name for each in search_order(ini, name)) for name in config_names(ini)):
        note = "without it a run does not end"
        added[GENERAL].append(Outcome(Action.ADDED, None, "sim-time-limit = 600s", note))
    return added


def _leave_to_user(by_section: dict[str, list[Outcome]]) -> bool:
    """Leave the first line to the user whose variable no other line defines. Return whether there is one."""
    texts = [each.text for outcomes in by_section.values() for each in outcomes if each.is_in_force]
    known = {name for text in texts for name in _DEFINED.findall(text)} | {*PREDEFINED}
    for outcomes in by_section.values():
        for number, outcome in enumerate(outcomes):
            names = _USED.findall(outcome.text) if outcome.is_in_force else []
            for name in [name for pair in names for name in pair if name and name not in known]:
                note = f"no line that is in force has the values of `{name}`"
                outcomes[number] = replace(outcome, action=Action.TO_WRITE, note=note)
                return True
    return False


def _text(file: Path, ini: IniFile, by_section: dict[str, list[Outcome]]) -> str:
    paragraphs = [f"# From {file.name}, by `gradysim import`.\n"]
    for section in ini.sections.values():
        rows = [_row(outcome) for outcome in by_section[section.name] if outcome.text]
        if rows or section.name != GENERAL:
            heading = "[General]" if section.name == GENERAL else f"[Config {section.name}]"
            paragraphs.append("\n".join([heading, *dict.fromkeys(rows)]) + "\n")
    return "\n".join(paragraphs)


def _row(outcome: Outcome) -> str:
    if not outcome.is_in_force:
        return f"# {outcome.action.value}: {' '.join(outcome.text.splitlines())}  ({outcome.note})"
    return outcome.text.replace("\n", "\n    ")
