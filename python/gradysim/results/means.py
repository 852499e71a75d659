"""Means over the runs of a study with confidence intervals, from the files of `--result-dir`."""

import os
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import astuple, dataclass
from pathlib import Path

from gradysim.results.confidence_interval import estimate
from gradysim.results.files import read_run_file
from gradysim.results.quantity import Names
from gradysim.results.quantity_table import QuantityTable, grouped
from gradysim.results.result_dir import read_results
from gradysim.results.result_hash import result_hash
from gradysim.results.run_summary import RunSummary
from gradysim.results.tracked_variables import REASONS


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
    found = []
    for study in grouped(results, lambda run: (run.config, run.mode)).values():
        table = QuantityTable(study)
        shown = table.shown(quantities)
        binary = {name for name in shown if table.is_binary(name)}
        for alike in grouped(study, lambda run: run.conditions.values).values():
            runs = QuantityTable(alike)
            for name, group in shown.items():
                left_out = None if group is None else _left_out(runs, group, name)
                if runs.numbers(name) or left_out is not None:
                    found.append(_mean(runs, name, left_out or "", binary=name in binary))
    return found


def _mean(runs: QuantityTable, quantity: str, left_out: str, *, binary: bool) -> Mean:
    numbers, first = runs.numbers(quantity), runs[0]
    mean, low, high = astuple(estimate(numbers, binary=binary)) if numbers else (None, None, None)
    return Mean(first.config, first.mode, first.iterations, quantity, len(numbers), mean, low, high, left_out)


def _left_out(table: QuantityTable, group: str, quantity: str) -> str | None:
    """Return the numbers of nodes without a finite number; None if the runs do not have such nodes."""
    reasons: Counter[str] = Counter()
    node_count = 0
    for runs in table.blocks:
        conditions = runs[0].conditions
        in_group = conditions.groups.get(group, 0)
        node_count += in_group * len(runs)
        if quantity not in conditions.positions:
            reasons["missing"] += in_group * len(runs)
    for run in table.incomplete:
        if quantity in run.left_out:
            reasons.update(run.left_out[quantity])
            if quantity not in run.conditions.positions:
                reasons["missing"] -= run.conditions.groups[group]
    text = ", ".join(f"{reasons[what]} {what}" for what in REASONS if reasons[what])
    if not node_count:
        return None
    return f"{text} of {node_count}" if text else ""


def of_different_settings(results: Iterable[RunSummary]) -> tuple[str, str] | None:
    """Return the names of two runs with equal values of variables but different settings, if any."""
    first: dict[str, RunSummary] = {}
    for result in (runs[0] for runs in QuantityTable(results).blocks):
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
    for alike in grouped(results, lambda result: (result.conditions.values, result.seed)).values():
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
    for result in (runs[0] for runs in QuantityTable(results).blocks):
        for name, file_hash in result.conditions.file_hashes.items():
            known, other = first.setdefault((result.config, name), (file_hash, result))
            if known != file_hash:
                one, another = (f"{each.name}.{each.mode}" for each in (other, result))
                return one, another, name
    return None
