"""Means over the runs of a study with confidence intervals, from the files of `--result-dir`."""

import os
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from pathlib import Path
from typing import TypeVar

from gradysim.results.confidence_interval import are_binary, estimate
from gradysim.results.files import read_run_file
from gradysim.results.quantity import Names, name_filter
from gradysim.results.result_dir import read_results
from gradysim.results.result_hash import result_hash
from gradysim.results.run_summary import Conditions, RunSummary
from gradysim.results.tracked_variables import REASONS

_Item = TypeVar("_Item")


@dataclass(frozen=True)
class Mean:
    """Mean of one quantity over the runs with the same values of iteration variables.

    Attributes:
        iterations: {name: value}, as the result files have it.
        quantity: `uavs[*] heard`: a tracked variable, the mean of a group's nodes; `unicast messages retry
            limit`: a ratio; `unicast messages delay in s`: the mean of a run's messages.
        runs: Number of runs with a number.
        mean: None if no run has a number.
        low: Lower end of the 95 % confidence interval; None for a single run.
        high: Upper end, likewise.
        left_out: Values of a tracked variable, at all nodes in all runs, that are left out because they are
            not finite numbers: `5 inf, 3 missing of 15`.
    """

    config: str
    mode: str
    iterations: Mapping[str, object]
    quantity: str
    runs: int
    mean: float | None
    low: float | None
    high: float | None
    left_out: str = ""


def read_means(directory: str | os.PathLike[str], quantities: Names | None = None) -> list[Mean]:
    """Return the means that `gradysim means` prints of a directory, or of a pack.

    Interrupted runs are left out. `quantities` selects by name, `"uavs[*] heard"` or
    `["*delay*", "unicast messages *"]`, with `*` for any characters and `?` for a single one. None selects
    all except numbers of the run itself, such as `cpu_s`. Raises ConfigError for a damaged file, and OSError.
    """
    return means(read_results(Path(directory)), quantities)


def means(results: Iterable[RunSummary], quantities: Names | None = None) -> list[Mean]:
    """Return the mean of each quantity over the runs with equal values of iteration variables.

    `quantities` selects as in `read_means`. A quantity that occurs in some runs of a configuration and mode
    has a row for all of their values. It is 0 in the other runs.
    """
    found: list[Mean] = []
    fits = name_filter(quantities)
    for study in _by(_blocks(results), lambda block: (block.conditions.config, block.conditions.mode)):
        variables = [
            each for each in _union(block.conditions.variables for block in study) if fits(" ".join(each))
        ]
        unlisted = () if quantities is not None else _union(block.conditions.unlisted for block in study)
        hidden_at_zero = _union(block.conditions.hidden_at_zero for block in study)
        shown = [
            name
            for name in _union(block.conditions.averages for block in study)
            if fits(name)
            and name not in unlisted
            and (name not in hidden_at_zero or any(_values(study, name)))
        ]
        binary = {each for each in variables if are_binary(_values(study, " ".join(each)))}
        for alike in _by(study, lambda block: block.conditions.values):
            for group, name in variables:
                found += _mean_of_variable(alike, group, name, binary=(group, name) in binary)
            for name in shown:
                if values := _values(alike, name):
                    found.append(_mean(alike, name, values))
    return found


@dataclass(frozen=True)
class _Block:
    """Runs of which all have the same conditions, as one object."""

    runs: Sequence[RunSummary]

    @property
    def conditions(self) -> Conditions:
        return self.runs[0].conditions

    @cached_property
    def columns(self) -> Mapping[str, Sequence[float]]:
        """Numbers of the runs by quantity."""
        columns = zip(*[run.row for run in self.runs], strict=True)
        return dict(zip(self.conditions.quantities, columns, strict=True))

    @cached_property
    def left_out(self) -> Sequence[Mapping[str, Mapping[str, int]]]:
        """What is left out of the runs, without those that have all numbers."""
        return [run.left_out for run in self.runs if run.left_out]


def _blocks(runs: Iterable[RunSummary]) -> list[_Block]:
    return [_Block(alike) for alike in _by(runs, lambda run: id(run.conditions))]


def _union(several: Iterable[Iterable[_Item]]) -> dict[_Item, None]:
    return dict.fromkeys(item for items in several for item in items)


def _values(blocks: Iterable[_Block], quantity: str) -> list[float]:
    """Return the numbers of a quantity, of the runs that have one."""
    return list(chain.from_iterable(block.columns.get(quantity, ()) for block in blocks))


def of_different_settings(results: Iterable[RunSummary]) -> tuple[str, str] | None:
    """Return the names of two runs with equal values of variables but different settings, if any."""
    first: dict[str, RunSummary] = {}
    for result in (block.runs[0] for block in _blocks(results)):
        other = first.setdefault(result.conditions.values, result)
        if other.settings_hash != result.settings_hash:
            return other.name, result.name
    return None


def repeated(results: Iterable[RunSummary]) -> list[tuple[str, str]]:
    """Return (original, repeated) names of runs that repeat another one.

    They have the same values of variables, seed, settings and result hash.
    """
    first: dict[object, RunSummary] = {}
    found = []
    for alike in _by(results, lambda result: (result.conditions.values, result.seed)):
        for result in alike if len(alike) > 1 else ():
            computed = result_hash(read_run_file(result.file))
            same = (result.conditions.values, result.seed, result.settings_hash, computed)
            other = first.setdefault(same, result)
            if other is not result:
                found.append((other.name, result.name))
    return found


def of_different_files(results: Iterable[RunSummary]) -> tuple[str, str, str] | None:
    """Return the names of two runs of one configuration and of a file that differs between them, if any.

    The values of their variables may differ, since such runs are compared with each other.
    """
    first: dict[tuple[str, str], tuple[str, RunSummary]] = {}
    for result in (block.runs[0] for block in _blocks(results)):
        for name, file_hash in result.conditions.file_hashes.items():
            known, other = first.setdefault((result.config, name), (file_hash, result))
            if known != file_hash:
                one, another = (f"{each.name}.{each.mode}" for each in (other, result))
                return one, another, name
    return None


def _by(items: Iterable[_Item], key: Callable[[_Item], object]) -> list[list[_Item]]:
    """Return items in groups of equal keys."""
    groups: dict[object, list[_Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return list(groups.values())


def _mean_of_variable(blocks: Sequence[_Block], group: str, name: str, *, binary: bool) -> Iterator[Mean]:
    quantity = f"{group} {name}"
    reasons: Counter[str] = Counter()
    node_count = 0
    for block in blocks:
        in_group = block.conditions.groups.get(group, 0)
        node_count += in_group * len(block.runs)
        others = [left_out[quantity] for left_out in block.left_out if quantity in left_out]
        for each in others:
            reasons.update(each)
        if quantity not in block.columns:
            reasons["missing"] += in_group * (len(block.runs) - len(others))
    if node_count:
        text = ", ".join(f"{reasons[what]} {what}" for what in REASONS if reasons[what])
        values = _values(blocks, quantity)
        yield _mean(blocks, quantity, values, f"{text} of {node_count}" if text else "", binary=binary)


def _mean(
    blocks: Sequence[_Block],
    quantity: str,
    values: Sequence[float],
    left_out: str = "",
    *,
    binary: bool = False,
) -> Mean:
    found = estimate(values, binary=binary) if values else None
    mean, low, high = (found.mean, found.low, found.high) if found else (None, None, None)
    first = blocks[0].conditions
    return Mean(
        first.config,
        first.mode,
        first.iterations,
        quantity,
        len(values),
        mean,
        low,
        high,
        left_out,
    )
