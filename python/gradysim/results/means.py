"""Mean values over the runs of a study, from the files that `--result-dir` holds."""

import json
import os
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gradysim.results.run_figures import RunFigures
from gradysim.results.shares import ALWAYS_TOLD
from gradysim.results.student import mean_with_half_width
from gradysim.results.wanted_names import Names, wanted

_FIELDS = {"config", "mode", "run", "interrupted", "fates", "nodes", "iterations"}
"""What tells a result of a run from other files."""


@dataclass(frozen=True)
class Mean:
    """One quantity of the runs with the same values of iteration variables.

    Attributes:
        iterations: {name: value}, as the results have it.
        quantity: `uavs[*] heard`: a tracked variable, the mean of a group's nodes; `unicast messages retry
            limit`: a share; `unicast messages delay in s`: the mean of a run's messages.
        runs: Those in which there was a number.
        mean: None if there was none in any run.
        half_width: Of the 95 % confidence interval; None for a single run.
        left_out: The values of a tracked variable, at all nodes in all runs, that are no finite numbers and
            left out: `5 inf, 3 missing of 15`.
    """

    config: str
    mode: str
    iterations: Mapping[str, object]
    quantity: str
    runs: int
    mean: float | None
    half_width: float | None
    left_out: str = ""


def read_means(directory: str | os.PathLike[str], quantities: Names | None = None) -> list[Mean]:
    """Return what `gradysim means` prints of a folder, without its warnings of runs that do not fit together.

    Runs that were interrupted are left out. `quantities` are those that are wanted, `"uavs[*] heard"` or
    `["*delay*", "unicast messages *"]`, with `*` for any letters and `?` for any one; None for all. Raises
    OSError.
    """
    fits = wanted(quantities)
    return [mean for mean in means(read_results(Path(directory))) if fits(mean.quantity)]


def read_results(directory: Path) -> list[RunFigures]:
    """Return what counts of the results in the files of a folder, in the order of configurations and runs.

    Files of other kinds, and runs that were interrupted, are left out. Raises OSError.
    """
    found = [RunFigures.of(result) for result in _results_in(directory) if not result["interrupted"]]
    return sorted(found, key=lambda result: (result.config, result.mode, result.run))


def has_files_for_omnetpp_alone(directory: Path) -> bool:
    """Whether a folder has result files for OMNeT++'s tools, and no other of any run. Raises OSError."""
    others = any(file.suffix in (".sca", ".vec") for file in directory.iterdir())
    return others and not any(_results_in(directory))


def _results_in(directory: Path) -> Iterator[dict[str, Any]]:
    """Give the results in the files of a folder, those of interrupted runs, too."""
    for file in sorted(directory.iterdir()):
        if file.suffix == ".json" and file.is_file():
            try:
                result = json.loads(file.read_text(encoding="utf-8"))
            except (ValueError, RecursionError):  # no JSON, or too deep
                continue
            if isinstance(result, dict) and result.keys() >= _FIELDS:
                yield result


def means(results: Iterable[RunFigures]) -> list[Mean]:
    """Return the mean of each quantity over the runs that have equal values of iteration variables.

    Which quantities there are, all runs of a configuration and a mode decide together, so that what was lost
    in some of them only is 0 in the others.
    """
    found: list[Mean] = []
    for study in _by(results, lambda result: (result.config, result.mode)):
        variables = dict.fromkeys(each for run in study for each in run.numeric_variables)
        told = dict.fromkeys(
            quantity
            for run in study
            for quantity, figure in run.figures.items()
            if figure or quantity.endswith(ALWAYS_TOLD)
        )
        for alike in _by(study, lambda result: result.values):
            for group, name in variables:
                found += _mean_of_variable(alike, group, name)
            for quantity in told:
                if values := [run.figures[quantity] for run in alike if quantity in run.figures]:
                    found.append(_mean(alike[0], quantity, values))
    return found


def of_different_settings(results: Iterable[RunFigures]) -> tuple[str, str] | None:
    """Name two of the runs with equal values of variables, if there are any whose settings differ."""
    first: dict[str, RunFigures] = {}
    for result in results:
        other = first.setdefault(result.values, result)
        if other.settings_hash != result.settings_hash:
            return _name(other), _name(result)
    return None


def repeated(results: Iterable[RunFigures]) -> list[tuple[str, str]]:
    """Name the runs that are another one over again, of equal values of variables, each after that one.

    They have its seed, its settings and all that it computed.
    """
    first: dict[object, RunFigures] = {}
    found = []
    for alike in _by(results, lambda result: (result.values, result.seed)):
        for result in alike:
            same = (result.values, result.seed, result.settings_hash, result.computed)
            other = first.setdefault(same, result)
            if other is not result:
                found.append((_name(other), _name(result)))
    return found


def of_different_files(results: Iterable[RunFigures]) -> tuple[str, str, str] | None:
    """Name two runs of one configuration, and a file of that name that differs between them, if there is one.

    They may be of different values: these are there to be compared.
    """
    first: dict[tuple[str, str], tuple[str, RunFigures]] = {}
    for result in results:
        for name, file_hash in result.file_hashes.items():
            known, other = first.setdefault((result.config, name), (file_hash, result))
            if known != file_hash:
                one, another = (f"{_name(each)}.{each.mode}" for each in (other, result))
                return one, another, name
    return None


def _name(result: RunFigures) -> str:
    return f"{result.config}-#{result.run}"


def _by(results: Iterable[RunFigures], key: Callable[[RunFigures], object]) -> list[list[RunFigures]]:
    """Return the results in groups of equal keys."""
    groups: dict[object, list[RunFigures]] = {}
    for result in results:
        groups.setdefault(key(result), []).append(result)
    return list(groups.values())


def _mean_of_variable(runs: Sequence[RunFigures], group: str, name: str) -> Iterator[Mean]:
    of_runs: list[float] = []
    left_out: Counter[str] = Counter()
    nodes = 0
    for of_group in (run.groups[group] for run in runs if group in run.groups):
        nodes += of_group.node_count
        variable = of_group.variable(name)
        left_out.update(variable.others)
        if variable.mean is not None:
            of_runs.append(variable.mean)
    if nodes:
        text = ", ".join(f"{count} {what}" for what, count in left_out.items())
        yield _mean(runs[0], f"{group} {name}", of_runs, f"{text} of {nodes}" if text else "")


def _mean(result: RunFigures, quantity: str, values: Sequence[float], left_out: str = "") -> Mean:
    mean, half_width = mean_with_half_width(values) if values else (None, None)
    return Mean(
        result.config,
        result.mode,
        result.iterations,
        quantity,
        len(values),
        mean,
        half_width,
        left_out,
    )
