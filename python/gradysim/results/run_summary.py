"""Summary of one run: what means, tables and figures need of a result file."""

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gradysim.results.quantity import averages_of
from gradysim.results.result import RunResult
from gradysim.results.tracked_variables import tracked_by_group, variables_of_group


@dataclass(frozen=True)
class RunSummary:
    """Summary of one run. A result file has all its nodes, and a study many result files.

    Attributes:
        values: Key of the runs that are averaged: configuration, mode and iteration variables.
        groups: Number of nodes by group.
        variables: (group, name) of tracked variables that are a number at any node, including infinity.
        averages: Names of the other quantities.
        hidden_at_zero: Those that have no row if they are 0 in all runs.
        unlisted: Those that have a row only if they are named.
        numbers: Numbers of the run by quantity. For a tracked variable: the mean of a group, if it has one.
        left_out: Nodes by quantity and reason whose value of a tracked variable is not a finite number.
        directory: Directory of the result file, or the pack that it was read from.
        file_name: Name of the result file.
    """

    config: str
    mode: str
    iterations: Mapping[str, object]
    settings_hash: object
    file_hashes: Mapping[str, str]
    values: str
    groups: Mapping[str, int]
    variables: tuple[tuple[str, str], ...]
    averages: tuple[str, ...]
    hidden_at_zero: frozenset[str]
    unlisted: frozenset[str]
    run: int
    seed: object
    numbers: Mapping[str, float]
    left_out: Mapping[str, Mapping[str, int]]
    directory: Path
    file_name: str

    @classmethod
    def of(cls, result: Mapping[str, Any], file: Path = Path()) -> "RunSummary":
        """Return the summary of a JSON object."""
        hashes = result.get("file_hashes")
        groups = tracked_by_group(result["nodes"])
        variables: list[tuple[str, str]] = []
        numbers: dict[str, float] = {}
        left_out: dict[str, Mapping[str, int]] = {}
        for group, nodes in groups.items():
            for name, variable in variables_of_group(nodes).items():
                quantity = f"{group} {name}"
                if variable.mean is not None:
                    numbers[quantity] = variable.mean
                if variable.others:
                    left_out[quantity] = variable.others
                if variable.is_numeric:
                    variables.append((group, name))
        averages = tuple(averages_of(RunResult, result))
        numbers.update((average.name, average.value) for average in averages)
        config, mode, iterations = result["config"], result["mode"], result["iterations"]
        return cls(
            config=config,
            mode=mode,
            iterations=iterations,
            settings_hash=result.get("settings_hash"),
            file_hashes=hashes if isinstance(hashes, dict) else {},
            values=json.dumps([config, mode, iterations], sort_keys=True),
            groups={group: len(nodes) for group, nodes in groups.items()},
            variables=tuple(variables),
            averages=tuple(average.name for average in averages),
            hidden_at_zero=frozenset(each.name for each in averages if not each.shown_at_zero),
            unlisted=frozenset(each.name for each in averages if not each.listed),
            run=result["run"],
            seed=result.get("seed"),
            numbers=numbers,
            left_out=left_out,
            directory=file.parent,
            file_name=file.name,
        )

    @property
    def file(self) -> Path:
        """The result file. `read_run_file` also finds it in a pack."""
        return self.directory / self.file_name

    @property
    def name(self) -> str:
        """Name for messages."""
        return f"{self.config}-#{self.run}"


def in_order(summaries: Iterable[RunSummary]) -> list[RunSummary]:
    """Return summaries sorted by configuration, mode and run. `Field5` comes before `Field15`."""
    summaries = list(summaries)
    configs = {config: _natural(config) for config in {summary.config for summary in summaries}}
    return sorted(summaries, key=lambda summary: (*configs[summary.config], summary.mode, summary.run))


def _natural(name: str) -> tuple[list[str], list[int]]:
    return re.split(r"\d+", name), [int(digits) for digits in re.findall(r"\d+", name)]
