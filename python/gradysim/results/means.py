"""Means over the runs of a study with confidence intervals, from the files of `--result-dir`."""

import hashlib
import json
import os
import re
import shlex
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from gradysim.results.confidence_interval import mean_with_half_width
from gradysim.results.files import is_run_file, read_run_file
from gradysim.results.outcomes import Outcomes
from gradysim.results.quantity import Average, Names, averages_of, name_filter
from gradysim.results.result import RunResult
from gradysim.results.tracked_variables import TrackedGroup, numeric_variables, tracked_by_group
from gradysim.scenario.errors import ConfigError, Source

_FIELDS = {"config", "mode", "run", "interrupted", "fates", "nodes", "iterations"}
"""Fields that distinguish the result of a run from other JSON files."""


@dataclass(frozen=True)
class Mean:
    """Mean of one quantity over the runs with the same values of iteration variables.

    Attributes:
        iterations: {name: value}, as the result files have it.
        quantity: `uavs[*] heard`: a tracked variable, the mean of a group's nodes; `unicast messages retry
            limit`: a ratio; `unicast messages delay in s`: the mean of a run's messages.
        runs: Number of runs with a number.
        mean: None if no run has a number.
        half_width: Of the 95 % confidence interval; None for a single run.
        left_out: Values of a tracked variable, at all nodes in all runs, that are left out because they are
            not finite numbers: `5 inf, 3 missing of 15`.
    """

    config: str
    mode: str
    iterations: Mapping[str, object]
    quantity: str
    runs: int
    mean: float | None
    half_width: float | None
    left_out: str = ""


@dataclass(frozen=True)
class RunSummary:
    """Summary of one run for means. A result has all its nodes, and a study many results.

    Attributes:
        computed: Hash of all computed values of the run.
        groups: Tracked variables by group of nodes.
        numeric_variables: (group, name) of those that are a number at any node, including infinity.
        averages: Numbers of the run, by name.
        fates: Outcomes of frames and messages; see `LEDGERS`.
        file: The result file.
    """

    config: str
    mode: str
    run: int
    iterations: Mapping[str, object]
    seed: object
    settings_hash: object
    file_hashes: Mapping[str, str]
    computed: str
    groups: Mapping[str, TrackedGroup]
    numeric_variables: tuple[tuple[str, str], ...]
    averages: Mapping[str, Average]
    fates: Outcomes
    file: Path

    @classmethod
    def of(cls, result: Mapping[str, Any], file: Path = Path()) -> "RunSummary":
        """Return the summary of a JSON object."""
        hashes = result.get("file_hashes")
        tracked = tracked_by_group(result["nodes"])
        return cls(
            result["config"],
            result["mode"],
            result["run"],
            result["iterations"],
            result.get("seed"),
            result.get("settings_hash"),
            hashes if isinstance(hashes, dict) else {},
            _hash([result.get(field) for field in ("fingerprint", "fates", "nodes")]),
            {group: TrackedGroup.of(nodes) for group, nodes in tracked.items()},
            tuple(numeric_variables(tracked)),
            {average.name: average for average in averages_of(RunResult, result)},
            result["fates"],
            file,
        )

    @cached_property
    def numbers(self) -> Mapping[str, float]:
        """Numbers of the run by quantity. For a tracked variable: the mean of a group, if it has one."""
        variables = {
            f"{group} {name}": mean
            for group, name in self.numeric_variables
            if (mean := self.groups[group].variable(name).mean) is not None
        }
        return variables | {name: average.value for name, average in self.averages.items()}

    @property
    def values(self) -> str:
        """Key of the runs that are averaged."""
        return json.dumps([self.config, self.mode, self.iterations], sort_keys=True)

    @property
    def name(self) -> str:
        """Name for messages."""
        return f"{self.config}-#{self.run}"


def _hash(content: object) -> str:
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def read_means(directory: str | os.PathLike[str], quantities: Names | None = None) -> list[Mean]:
    """Return the means that `gradysim means` prints of a directory.

    Interrupted runs are left out. `quantities` selects by name, `"uavs[*] heard"` or
    `["*delay*", "unicast messages *"]`, with `*` for any characters and `?` for a single one. None selects
    all except numbers of the run itself, such as `cpu_s`. Raises ConfigError for a damaged file, and OSError.
    """
    return means(read_results(Path(directory)), quantities)


def read_results(directory: Path) -> list[RunSummary]:
    """Return summaries of the runs in a directory, sorted by configuration, mode and run.

    Other files and interrupted runs are left out. Raises ConfigError for a damaged file, and OSError.
    """
    found = [
        RunSummary.of(result, file) for file, result in _results_in(directory) if not result["interrupted"]
    ]
    return sorted(found, key=lambda result: (*_natural(result.config), result.mode, result.run))


def _natural(name: str) -> tuple[list[str], list[int]]:
    """Return a key that sorts `Field5` before `Field15`."""
    return re.split(r"\d+", name), [int(digits) for digits in re.findall(r"\d+", name)]


def has_files_for_omnetpp_alone(directory: Path) -> bool:
    """Return whether a directory has `.sca` or `.vec` files, but no JSON file of a run."""
    others = any(file.suffix in (".sca", ".vec") for file in directory.iterdir())
    return others and not any(_results_in(directory))


def _results_in(directory: Path) -> Iterator[tuple[Path, dict[str, Any]]]:
    """Yield the result files in a directory and their JSON objects, including those of interrupted runs.

    Raises ConfigError for a damaged one, and OSError.
    """
    for file in sorted(directory.iterdir()):
        if file.suffix == ".json" and file.is_file():
            try:
                result = read_run_file(file)
            except ValueError as error:
                if is_run_file(file.name):
                    raise ConfigError(
                        f"it is damaged: {error}",
                        Source(file, 0),
                        expected="the file as its run left it; to do the run again, use"
                        f" `gradysim run FILE --result-dir {shlex.quote(str(directory))} --resume`",
                    ) from error
                continue
            if result.keys() >= _FIELDS:
                yield file, result


def means(results: Iterable[RunSummary], quantities: Names | None = None) -> list[Mean]:
    """Return the mean of each quantity over the runs with equal values of iteration variables.

    `quantities` selects as in `read_means`. A quantity that occurs in some runs of a configuration and mode
    has a row for all of their values. It is 0 in the other runs.
    """
    found: list[Mean] = []
    fits = name_filter(quantities)
    for study in _by(results, lambda result: (result.config, result.mode)):
        variables = [
            each
            for each in dict.fromkeys(each for run in study for each in run.numeric_variables)
            if fits(" ".join(each))
        ]
        shown = dict.fromkeys(
            name
            for run in study
            for name, average in run.averages.items()
            if (average.value or average.shown_at_zero)
            and fits(name)
            and (average.listed or quantities is not None)
        )
        for alike in _by(study, lambda result: result.values):
            for group, name in variables:
                found += _mean_of_variable(alike, group, name)
            for name in shown:
                if values := [run.averages[name].value for run in alike if name in run.averages]:
                    found.append(_mean(alike[0], name, values))
    return found


def of_different_settings(results: Iterable[RunSummary]) -> tuple[str, str] | None:
    """Return the names of two runs with equal values of variables but different settings, if any."""
    first: dict[str, RunSummary] = {}
    for result in results:
        other = first.setdefault(result.values, result)
        if other.settings_hash != result.settings_hash:
            return other.name, result.name
    return None


def repeated(results: Iterable[RunSummary]) -> list[tuple[str, str]]:
    """Return (original, repeated) names of runs that repeat another one.

    They have the same values of variables, seed, settings and results.
    """
    first: dict[object, RunSummary] = {}
    found = []
    for alike in _by(results, lambda result: (result.values, result.seed)):
        for result in alike:
            same = (result.values, result.seed, result.settings_hash, result.computed)
            other = first.setdefault(same, result)
            if other is not result:
                found.append((other.name, result.name))
    return found


def of_different_files(results: Iterable[RunSummary]) -> tuple[str, str, str] | None:
    """Return the names of two runs of one configuration and of a file that differs between them, if any.

    The values of their variables may differ, since such runs are compared with each other.
    """
    first: dict[tuple[str, str], tuple[str, RunSummary]] = {}
    for result in results:
        for name, file_hash in result.file_hashes.items():
            known, other = first.setdefault((result.config, name), (file_hash, result))
            if known != file_hash:
                one, another = (f"{each.name}.{each.mode}" for each in (other, result))
                return one, another, name
    return None


def _by(results: Iterable[RunSummary], key: Callable[[RunSummary], object]) -> list[list[RunSummary]]:
    """Return the results in groups of equal keys."""
    groups: dict[object, list[RunSummary]] = {}
    for result in results:
        groups.setdefault(key(result), []).append(result)
    return list(groups.values())


def _mean_of_variable(runs: Sequence[RunSummary], group: str, name: str) -> Iterator[Mean]:
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


def _mean(result: RunSummary, quantity: str, values: Sequence[float], left_out: str = "") -> Mean:
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
