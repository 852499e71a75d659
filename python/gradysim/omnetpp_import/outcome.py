"""What was done with a line of the file."""

from dataclasses import dataclass
from enum import Enum

from gradysim.scenario.parse.ini import Entry


class Action(Enum):
    """What was done with a line."""

    KEPT = "kept"
    RENAMED = "renamed"
    ADDED = "added"
    LEFT_OUT = "left out"
    NOT_MODELLED = "not modelled"
    TO_WRITE = "to write"


@dataclass(frozen=True)
class Outcome:
    """One line of the list.

    Attributes:
        action: What was done.
        entry: The line of the file; None for one that the file does not have.
        text: The line here, "" if there is none. For `TO_WRITE` the user completes it. For `NOT_MODELLED` it
            is the line there.
        note: Why, or what for.
    """

    action: Action
    entry: Entry | None = None
    text: str = ""
    note: str = ""

    @property
    def is_in_force(self) -> bool:
        """Whether the line is one of the translated file, and not a comment in it."""
        return bool(self.text) and self.action not in (Action.TO_WRITE, Action.NOT_MODELLED)


def renamed(entry: Entry, key: str, text: str = "") -> Outcome:
    """Return the outcome of a line with another key or value, or with the same ones."""
    line = f"{key} = {text or entry.text}"
    return Outcome(Action.KEPT if line == f"{entry.key} = {entry.text}" else Action.RENAMED, entry, line)


def left_out(entry: Entry, note: str) -> Outcome:
    """Return the outcome of a line without a meaning here."""
    return Outcome(Action.LEFT_OUT, entry, note=note)


def not_modelled(entry: Entry, note: str) -> Outcome:
    """Return the outcome of a line that has an effect there and none here."""
    return Outcome(Action.NOT_MODELLED, entry, f"{entry.key} = {entry.text}", note)
