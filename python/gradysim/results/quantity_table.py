"""Runs and their quantities as one table, which means, comparisons and figures read."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any, TypeVar

from gradysim.results.confidence_interval import are_binary
from gradysim.results.quantity import Names, name_filter, quantities
from gradysim.results.result import RunResult
from gradysim.results.run_summary import RunSummary

_Item = TypeVar("_Item")
_Key = TypeVar("_Key")

OF_RUN = ("config", "mode", "run", "seed")
"""Columns of each table, and names of variables, in addition to iteration variables."""

TAKEN = {*quantities(RunResult), "node", "quantity", "time_s", "value", "runs", "mean", "low", "high"}
"""Names of other columns. An iteration variable with such a name has the column `$mode` and so on."""


def column_of(variable: str) -> str:
    """Return the name of the column of an iteration variable."""
    return f"${variable}" if variable in TAKEN else variable


def variables_of(run: RunSummary) -> dict[str, Any]:
    """Return the values that distinguish a run, by the names of their columns: `OF_RUN`, then variables."""
    own = {name: getattr(run, name) for name in OF_RUN}
    return own | {column_of(name): value for name, value in run.iterations.items()}


def values_of(run: RunSummary, variables: Iterable[str]) -> tuple[Any, ...]:
    """Return the values of some variables; None for those that the run does not have."""
    values = variables_of(run)
    return tuple(map(values.get, variables))


def grouped(items: Iterable[_Item], key: Callable[[_Item], _Key]) -> dict[_Key, list[_Item]]:
    """Return items by key, in their order."""
    groups: dict[_Key, list[_Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return groups


def union(several: Iterable[Iterable[_Item]]) -> list[_Item]:
    """Return the different items of several sequences, in the order in which they appear."""
    return list(dict.fromkeys(item for items in several for item in items))


class QuantityTable:
    """A row for each run, with its variables and its numbers: a sequence of `RunSummary`."""

    def __init__(self, summaries: Iterable[RunSummary]) -> None:
        """Store runs in their order."""
        self._runs = tuple(summaries)

    def __len__(self) -> int:
        return len(self._runs)

    def __iter__(self) -> Iterator[RunSummary]:
        return iter(self._runs)

    def __getitem__(self, index: int) -> RunSummary:
        return self._runs[index]

    @cached_property
    def blocks(self) -> Sequence[Sequence[RunSummary]]:
        """The runs that share one `Conditions` object, as up to 100,000 repetitions do."""
        return list(grouped(self._runs, lambda run: id(run.conditions)).values())

    @cached_property
    def columns_of_numbers(self) -> Mapping[str, Sequence[float]]:
        """The numbers by quantity, of the runs that have one."""
        columns: dict[str, list[float]] = defaultdict(list)
        for runs in self.blocks:
            rows = zip(*[run.row for run in runs], strict=True)
            for quantity, numbers in zip(runs[0].conditions.quantities, rows, strict=True):
                columns[quantity] += numbers
        return columns

    @cached_property
    def incomplete(self) -> Sequence[RunSummary]:
        """The runs with nodes whose tracked variables are not all finite numbers."""
        return [run for run in self._runs if run.left_out]

    def numbers(self, quantity: str) -> Sequence[float]:
        """Return the numbers of a quantity, of the runs that have one."""
        return self.columns_of_numbers.get(quantity, ())

    @property
    def quantities(self) -> list[str]:
        """Names of the numbers of any run: those of `gradysim means`, then `cpu_s`, `events` and so on."""
        return union(runs[0].conditions.quantities for runs in self.blocks)

    def is_binary(self, quantity: str) -> bool:
        """Return whether the quantity is binary in all runs, as `RunSummary.is_binary` defines it."""
        is_share = any(quantity in runs[0].conditions.averages for runs in self.blocks)
        return not is_share and are_binary(self.numbers(quantity))

    def shown(self, wanted: Names | None = None) -> dict[str, str | None]:
        """Return the quantities that `gradysim means` prints, with the group of each tracked variable.

        `wanted` selects by name, as in `read_means`.
        """
        of_blocks = [runs[0].conditions for runs in self.blocks]
        tracked = {f"{group} {name}": group for each in of_blocks for group, name in each.variables}
        hidden = {name for each in of_blocks for name in each.hidden_at_zero if not any(self.numbers(name))}
        if wanted is None:
            hidden.update(*(each.unlisted for each in of_blocks))
        others = union(each.averages for each in of_blocks)
        fits = name_filter(wanted)
        return {
            name: tracked.get(name)
            for name in [*tracked, *(other for other in others if other not in hidden)]
            if fits(name)
        }
