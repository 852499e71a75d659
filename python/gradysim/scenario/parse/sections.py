"""The sections of a configuration: its own, those that it extends, and [General]."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from gradysim.scenario.errors import ConfigError, Source, nearest
from gradysim.scenario.parse.ini import GENERAL, Entry, IniFile, Section

_DEEPEST = 100
"""Limit for chains of sections; Python's stack has such a limit, too."""

_MAX_NAMES = 20
"""Configurations that a message lists."""


def search_order(ini: IniFile, config: str, levels: Sequence[str] = ()) -> list[Section]:
    """Return the levels, the configuration's own section, its bases by C3 linearization, then [General].

    The last level comes first.

    Raises:
        ConfigError: The configuration or a level does not exist, or its bases cannot be ordered.
    """
    for level in levels:
        if level not in ini.levels:
            raise ConfigError(
                f"no level `{level}`",
                Source(ini.file, 0),
                expected=f"a section [Level {level}]",
                suggestion=nearest(level, ini.levels),
            )
    if config not in ini.sections:
        names = config_names(ini)
        raise ConfigError(
            f"no configuration `{config}`",
            Source(ini.file, 0),
            expected=f"one of {', '.join(names)}",
            suggestion=nearest(config, names),
        )
    names = [name for name in _linearize(ini, config, (), {}) if name != GENERAL]
    return [
        *(ini.levels[level] for level in reversed(levels)),
        *(ini.sections[name] for name in [*names, GENERAL]),
    ]


def check_not_abstract(ini: IniFile, config: str) -> None:
    """Raise ConfigError if a configuration is abstract: its runs can be listed, but not started."""
    abstract = _own_option(ini.sections[config], "abstract")
    if abstract is not None and _is_true(abstract):
        heirs = [name for name in config_names(ini) if name != config]
        raise ConfigError(
            f"configuration `{config}` is abstract",
            abstract.source,
            expected=f"one of {', '.join(heirs) or 'those that extend it'}",
        )


def entries_in_order(overrides: Iterable[Entry], sections: Iterable[Section]) -> list[Entry]:
    """Return all entries of a configuration in search order, with the ranks of their sections."""
    of_sections = (
        replace(entry, rank=rank) for rank, section in enumerate(sections, 1) for entry in section.entries
    )
    return [*overrides, *of_sections]


def config_names(ini: IniFile) -> list[str]:
    """Return the configurations that can be run, in the order of the file; General only if it is alone."""
    names = [
        name
        for name, section in ini.sections.items()
        if name != GENERAL and not ((entry := _own_option(section, "abstract")) and _is_true(entry))
    ]
    return names or [GENERAL]


def unused_sections(ini: IniFile, used: Sequence[Section]) -> list[str]:
    """Return the sections that are not in `used` and that no section extends."""
    extended = {
        base.strip()
        for section in ini.sections.values()
        if (entry := _own_option(section, "extends"))
        for base in entry.text.split(",")
    }
    names = {section.name for section in used} | extended
    return [name for name in ini.sections if name not in names]


def _linearize(ini: IniFile, name: str, heirs: tuple[str, ...], known: dict[str, list[str]]) -> list[str]:
    """Return a section and its bases in order. `heirs` lead to it; `known` are the orders found before."""
    if name in known:
        return known[name]
    section = ini.sections[name]
    extends = _own_option(section, "extends")
    if extends is None or name == GENERAL:
        if extends is not None:
            raise ConfigError("[General] is the base of all", extends.source, expected="no `extends` in it")
        return [name]
    bases = _bases(ini, extends)
    if cycle := [base for base in bases if base == name or base in heirs]:
        text = f"`{name}` extends itself through `{cycle[0]}`"
        raise ConfigError(text, extends.source, expected="no cycle")
    if len(heirs) == _DEEPEST:
        raise ConfigError(
            f"more than {_DEEPEST} sections in a row extend each other", extends.source, expected="fewer"
        )
    chains = [_linearize(ini, base, (*heirs, name), known) for base in bases]
    merged = _merge([*chains, bases])
    if merged is None:
        raise ConfigError(
            f"the bases of `{name}` contradict each other in their order",
            extends.source,
            expected="one order everywhere",
        )
    known[name] = [name, *merged]
    return known[name]


def _merge(chains: list[list[str]]) -> list[str] | None:
    """Merge chains as C3 does: take the first head that is in no tail. None if there is none."""
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
        raise ConfigError.at(extends.source, "a section is repeated", expected="each section once")
    return bases


def _own_option(section: Section, name: str) -> Entry | None:
    return next((entry for entry in section.entries if entry.key == name), None)


def _is_true(entry: Entry) -> bool:
    if entry.text not in ("true", "false"):
        raise ConfigError.at(entry.source, f"`{entry.text}` is not a boolean", expected="true or false")
    return entry.text == "true"


def what_to_run_instead(ini: IniFile, config: str, sections: Sequence[Section], name: str) -> str:
    """Return the end of a message about an incomplete configuration: a misspelled section, or the others.

    `name` is the option for the name of a configuration.
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
