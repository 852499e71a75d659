"""Translates all configurations of an `omnetpp.ini`, and lists what was done with each of its lines."""

import os
import re
from collections import Counter, deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

from gradysim.omnetpp_import.defaults import defaults_of, indexed, missing_classes, translated_lines
from gradysim.omnetpp_import.lines import LineTranslator
from gradysim.omnetpp_import.ned import NedNetwork, read_networks
from gradysim.omnetpp_import.node_ids import name_by_ids
from gradysim.omnetpp_import.outcome import Action, Outcome
from gradysim.omnetpp_import.tables import CLASS_TO_WRITE
from gradysim.scenario.parse.ini import GENERAL, Entry, IniFile, read_ini
from gradysim.scenario.parse.sections import config_names, search_order
from gradysim.scenario.resolve.sweep import PREDEFINED
from gradysim.scenario.schema.options import NETWORK

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
    orders = {name: search_order(ini, name) for name in ini.sections}
    lines = LineTranslator(orders, size_keys, os.path.relpath(file.parent, folder))
    by_section = {section.name: [lines.outcome(entry) for entry in section.entries] for section in sections}
    _leave_to_user(by_section)
    for name, of_section in _added(ini, used, entries, by_section).items():
        by_section[name] += of_section
    name_by_ids(by_section, [orders[name] for name in config_names(ini)])
    of_file = [each for section in sections for each in by_section[section.name][: len(section.entries)]]
    added = [each for section in sections for each in by_section[section.name][len(section.entries) :]]
    return Translation(_text(file, ini, by_section), (*of_file, *added))


def _added(
    ini: IniFile,
    used: Mapping[str, NedNetwork],
    entries: Sequence[Entry],
    by_section: Mapping[str, Sequence[Outcome]],
) -> dict[str, list[Outcome]]:
    """Return what the file lacks, by section. `used` are the networks, by the sections that choose them."""
    added = _defaults(ini, used, entries, by_section)
    limited = {
        name
        for name, outcomes in by_section.items()
        if any(each.is_in_force and each.text.startswith("sim-time-limit ") for each in outcomes)
    }
    if any(limited.isdisjoint(each.name for each in search_order(ini, name)) for name in config_names(ini)):
        note = "without it a run does not end"
        added[GENERAL].append(Outcome(Action.ADDED, None, "sim-time-limit = 600s", note))
    return added


def _defaults(
    ini: IniFile,
    used: Mapping[str, NedNetwork],
    entries: Sequence[Entry],
    by_section: Mapping[str, Sequence[Outcome]],
) -> dict[str, list[Outcome]]:
    """Return what the networks say and the file does not, by section."""
    added: dict[str, list[Outcome]] = {name: [] for name in ini.sections}
    if not used:
        return added
    before = indexed(entries)
    lines = indexed(translated_lines(chain.from_iterable(by_section.values())))
    is_one = len({id(network) for network in used.values()}) == 1
    for name, network in list(used.items())[: 1 if is_one else None]:
        always = [GENERAL, name] if not is_one or len(used) == 1 else [GENERAL]
        in_force = indexed(translated_lines(chain.from_iterable(map(by_section.__getitem__, always))))
        added[GENERAL if is_one else name] += [
            *defaults_of(network, before, lines, in_force),
            *missing_classes(network, before, lines, in_force),
        ]
    return added


def _leave_to_user(by_section: Mapping[str, list[Outcome]]) -> None:
    """Leave lines to the user whose variables no other line defines, and so on with those they define."""
    definitions = Counter(PREDEFINED)
    uses: dict[str, list[tuple[list[Outcome], int]]] = {}
    for outcomes in by_section.values():
        for number, outcome in enumerate(outcomes):
            if outcome.is_in_force:
                definitions.update(_DEFINED.findall(outcome.text))
                for name in filter(None, chain.from_iterable(_USED.findall(outcome.text))):
                    uses.setdefault(name, []).append((outcomes, number))
    undefined = deque(name for name in uses if not definitions[name])
    while undefined:
        name = undefined.popleft()
        for outcomes, number in uses.get(name, ()):
            outcome = outcomes[number]
            if outcome.is_in_force:
                note = f"no line that is in force has the values of `{name}`"
                outcomes[number] = replace(outcome, action=Action.TO_WRITE, note=note)
                for defined in _DEFINED.findall(outcome.text):
                    definitions[defined] -= 1
                    if not definitions[defined]:
                        undefined.append(defined)


def _text(file: Path, ini: IniFile, by_section: dict[str, list[Outcome]]) -> str:
    paragraphs = [f"# From {file.name}, by `gradysim import`.\n"]
    for section in ini.sections.values():
        rows = [_row(outcome) for outcome in by_section[section.name] if outcome.text]
        if rows or section.name != GENERAL:
            heading = "[General]" if section.name == GENERAL else f"[Config {section.name}]"
            paragraphs.append("\n".join([heading, *dict.fromkeys(rows)]) + "\n")
    return "\n".join(paragraphs)


def _row(outcome: Outcome) -> str:
    if outcome.text.endswith(
        CLASS_TO_WRITE
    ):  # a line in force, or nodes would run the class of another section
        key, _, text = outcome.text.partition(" = ")
        return f"{key} = default  # {outcome.action.value}: {text}  ({outcome.note})"
    if not outcome.is_in_force:
        return f"# {outcome.action.value}: {' '.join(outcome.text.splitlines())}  ({outcome.note})"
    return outcome.text.replace("\n", "\n    ")
