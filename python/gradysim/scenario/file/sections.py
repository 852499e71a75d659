"""Which sections a configuration consists of, in the order in which they are searched."""

from collections.abc import Sequence
from typing import NamedTuple

from gradysim.scenario.errors import ConfigError, Source, nearest
from gradysim.scenario.file.reader import GENERAL, Entry, IniFile, Section

_MAX_NAMES = 20
"""Configurations that a message lists."""

_DEEPEST = 100
"""Sections that extend each other in a row; Python's stack has such a limit, too."""


class Ranked(NamedTuple):
    """An entry with the place of its section in the order of the search.

    Attributes:
        rank: 0 is the command line, the highest is [General].
        entry: The entry.
    """

    rank: int
    entry: Entry


def search_order(ini: IniFile, config: str) -> list[Section]:
    """The configuration's own section, then its bases by C3 linearisation, [General] last.

    Raises:
        ConfigError: There is no such configuration, it is abstract, or its bases make no order.
    """
    if config not in ini.sections:
        names = config_names(ini)
        raise ConfigError(
            f"no configuration `{config}`",
            Source(ini.file, 0),
            expected=f"one of {', '.join(names)}",
            suggestion=nearest(config, names),
        )
    section = ini.sections[config]
    if (abstract := _own_option(section, "abstract")) and _is_true(abstract):
        heirs = [name for name in config_names(ini) if name != config]
        raise ConfigError(
            f"configuration `{config}` is abstract, it is only there to be extended; "
            f"expected one of {', '.join(heirs) or 'those that extend it'}",
            abstract.source,
        )
    names = [name for name in _linearise(ini, config, (), {}) if name != GENERAL]
    return [ini.sections[name] for name in [*names, GENERAL]]


def config_names(ini: IniFile) -> list[str]:
    """Names of the configurations that can be run, in the order of the file; General only if it is alone."""
    names = [
        name
        for name, section in ini.sections.items()
        if name != GENERAL and not ((entry := _own_option(section, "abstract")) and _is_true(entry))
    ]
    return names or [GENERAL]


def unused_sections(ini: IniFile, used: Sequence[Section]) -> list[str]:
    """Names of the sections that are not `used` and that no other section extends."""
    extended = {
        base.strip()
        for section in ini.sections.values()
        if (entry := _own_option(section, "extends"))
        for base in entry.text.split(",")
    }
    names = {section.name for section in used} | extended
    return [name for name in ini.sections if name not in names]


def _linearise(ini: IniFile, name: str, heirs: tuple[str, ...], known: dict[str, list[str]]) -> list[str]:
    """A section and its bases in their order; `heirs` lead to it, and `known` are the orders found before."""
    if name in known:
        return known[name]
    section = ini.sections[name]
    extends = _own_option(section, "extends")
    if extends is None or name == GENERAL:
        if extends is not None:
            raise ConfigError("[General] is the base of all; expected no `extends` in it", extends.source)
        return [name]
    bases = _bases(ini, extends)
    if cycle := [base for base in bases if base == name or base in heirs]:
        raise ConfigError(f"`{name}` extends itself through `{cycle[0]}`; expected no circle", extends.source)
    if len(heirs) == _DEEPEST:
        raise ConfigError(
            f"more than {_DEEPEST} sections in a row extend each other; expected fewer", extends.source
        )
    chains = [_linearise(ini, base, (*heirs, name), known) for base in bases]
    merged = _merge([*chains, bases])
    if merged is None:
        raise ConfigError(
            f"the bases of `{name}` contradict each other in their order; expected one order everywhere",
            extends.source,
        )
    known[name] = [name, *merged]
    return known[name]


def _merge(chains: list[list[str]]) -> list[str] | None:
    """The merge step of C3: each time the first head that is in no other tail. None if there is none."""
    merged: list[str] = []
    remaining = [list(chain) for chain in chains if chain]
    while remaining:
        for chain in remaining:
            head = chain[0]
            if not any(head in other[1:] for other in remaining):
                break
        else:
            return None
        merged.append(head)
        remaining = [rest for chain in remaining if (rest := [name for name in chain if name != head])]
    return merged


def _bases(ini: IniFile, extends: Entry) -> list[str]:
    bases = [base.strip() for base in extends.text.split(",")]
    for base in bases:
        if base not in ini.sections:
            raise ConfigError(
                f"extends `{base}`",
                extends.source,
                expected="the name of a section",
                suggestion=nearest(base, ini.sections),
            )
    if len(set(bases)) < len(bases):
        raise ConfigError(f"extends = {extends.text}: expected each section once", extends.source)
    return bases


def _own_option(section: Section, name: str) -> Entry | None:
    return next((entry for entry in section.entries if entry.key == name), None)


def _is_true(entry: Entry) -> bool:
    if entry.text not in ("true", "false"):
        raise ConfigError(f"{entry.key} = {entry.text}: expected true or false", entry.source)
    return entry.text == "true"


def what_to_run_instead(ini: IniFile, config: str, sections: Sequence[Section], name: str) -> str:
    """What to add to an error of a configuration that lacks something: a misspelt section, or the others.

    `name` is what the caller calls that of a configuration.
    """
    unused = unused_sections(ini, sections)
    general_is_empty = not ini.sections[GENERAL].entries
    match = nearest(GENERAL, unused) if general_is_empty else ""
    if match:
        return f"; [{match}] at line {ini.sections[match].source.line} is not used: did you mean [{GENERAL}]?"
    names = config_names(ini)
    if config in names:
        return ""
    listed = ", ".join(names[:_MAX_NAMES]) + (", …" if len(names) > _MAX_NAMES else "")
    return f"; or run another configuration of the file: `{name} NAME`, {listed}"
