"""What the entries in force say of one struct of a configuration."""

from collections.abc import Callable, Mapping

from gradysim.scenario.matching.lookup import Found
from gradysim.scenario.schema import Key
from gradysim.scenario.settings import Setting, SettingReader


def read_struct(
    struct: str, found: Mapping[Key, Found], settings: SettingReader, path_of: Callable[[Key], str]
) -> dict[str, Setting]:
    """The fields of one struct that entries set. Of two keys for one field the first entry is in force.

    `path_of` gives the path of a key's parameter below the network.
    """
    first: dict[str, tuple[Found, Key]] = {}
    for key, entry in found.items():
        if key.struct == struct and (key.field not in first or entry.order < first[key.field][0].order):
            first[key.field] = (entry, key)
    return {
        field: settings.setting(entry.entry, key.kind, path_of(key))
        for field, (entry, key) in first.items()
        if not entry.is_default
    }
