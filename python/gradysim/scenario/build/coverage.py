"""Chooses the runs of a large study that are checked before the first run starts."""

import re
from collections.abc import Iterable, Mapping, Sequence

from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.resolve.runs import NumberedRuns
from gradysim.scenario.resolve.sweep import (
    LABELS,
    OF_ALL_VALUES,
    PREDEFINED,
    REPETITION,
    IterationVariable,
    variables_in,
)
from gradysim.scenario.schema.options import is_ignored, is_option

_MAKES_NODES = re.compile(r"(?:.*\.)?(?:num[A-Z]\w*|count|class|typename)", re.ASCII)
"""Keys whose values say which other lines are read: numbers of nodes, protocols and models."""

_OF_EACH_RUN = ("runnumber", "seedset")


class Coverage:
    """Finds the runs with values that earlier runs do not have.

    A line is new with each combination of the values in it. Lines that choose nodes and models count as one
    line, so that each combination of these is new. Values that differ in each run, such as `${runnumber}`, do
    not count.
    """

    def __init__(
        self,
        lines: Sequence[Entry],
        options: Mapping[str, Entry],
        checked: Iterable[Entry],
        variables: Sequence[IterationVariable],
        runs: NumberedRuns,
    ) -> None:
        """Start before the first of `runs`.

        Args:
            lines: All lines. Their values have variables.
            options: The options in force, by name.
            checked: Those of the options whose values may be wrong in some runs.
            variables: All variables.
            runs: The wanted runs.
        """
        self._indices = runs.indices
        self._options = options
        self._names = [variable.name for variable in variables]
        parameters = [line for line in lines if not is_option(line) and not is_ignored(line)]
        of_lines = [self._read_by(line) for line in parameters]
        choices = [self._read_by(line) for line in parameters if _MAKES_NODES.fullmatch(line.key)]
        of_options = map(self._read_by, checked)
        combinations = runs.combinations
        self._of_network = combinations.strides(self._known(set().union(*of_lines)))
        self._differs_always = any(name in _OF_EACH_RUN for names in of_lines for name in names)
        together = {
            frozenset(self._known(names)) for names in (*of_lines, *of_options, set().union(*choices))
        }
        self._unseen = [(combinations.strides(names), set[tuple[int, ...]]()) for names in together]

    def _read_by(self, entry: Entry, *within: Entry) -> set[str]:
        """Return the variables that the value of an entry depends on; it stands in the labels `within`."""
        names: set[str] = set()
        for name in variables_in(entry.text):
            label = self._options.get(f"{name}-label") if name in LABELS else None
            if label is not None and label not in within:
                names |= self._read_by(label, label, *within)
            elif LABELS.get(name, name) in OF_ALL_VALUES:
                names.update(self._names)
            else:
                names.add(LABELS.get(name, name))
        return names

    def _known(self, names: Iterable[str]) -> list[str]:
        """Return those of the names that are variables with several values."""
        return [name for name in names if name == REPETITION or name not in PREDEFINED]

    def network_of(self, index: int) -> tuple[int, ...]:
        """Return a key that is equal for runs whose networks have the same values, except for their seeds."""
        combination = self._indices[index]
        values = tuple([combination // stride % size for stride, size in self._of_network])
        return (*values, combination) if self._differs_always else values

    def adds_a_value(self, index: int) -> bool:
        """Return whether a run has a value that none of the runs asked for before has."""
        combination = self._indices[index]
        is_new = False
        for strides, seen in self._unseen:
            values = tuple([combination // stride % size for stride, size in strides])
            if values not in seen:
                seen.add(values)
                is_new = True
        return is_new
