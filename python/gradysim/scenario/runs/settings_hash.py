"""A hash of what a file and a command line say of one run: whether a result is that of the same settings."""

import hashlib
from collections.abc import Iterable

from gradysim.scenario.file.sections import Ranked
from gradysim.scenario.matching.lookup import is_ignored
from gradysim.scenario.options import NETWORK
from gradysim.scenario.runs.file_hashes import HASH_DIGITS
from gradysim.scenario.runs.labels import LABEL_OPTIONS

OF_NO_RUN = (
    "repeat",
    "constraint",
    "iteration-nesting-order",
    "description",
    NETWORK,
    "extends",
    "abstract",
    *LABEL_OPTIONS,
)
"""Options that say which runs there are, or nothing of what happens in them."""


def entries_of_the_hash(ranked: Iterable[Ranked]) -> list[Ranked]:
    """Return the entries that count: the first one of each key, if it says something of a run."""
    first: dict[str, Ranked] = {}
    for rank, entry in ranked:
        if entry.key not in OF_NO_RUN and not is_ignored(entry):
            first.setdefault(entry.key, Ranked(rank, entry))
    return list(first.values())


def settings_hash(entries: Iterable[Ranked]) -> str:
    """Return the hash of entries whose variables have been replaced: of keys, values and their order."""
    text = "\0".join(f"{entry.key}={entry.text}" for _, entry in entries)
    return hashlib.sha256(text.encode()).hexdigest()[:HASH_DIGITS]
