"""Summary of one run: what means, tables and figures need of a result file."""

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from gradysim.notebook import HEIGHT_PX, ReplayView
from gradysim.results.quantity import averages_of
from gradysim.results.result import RunResult
from gradysim.results.tracked_variables import tracked_by_group, variables_of_group


@dataclass(frozen=True)
class Conditions:
    """What repetitions of a run have in common. They share one object, which makes means fast.

    Attributes:
        groups: Number of nodes by group.
        variables: (group, name) of tracked variables that are a number at any node, including infinity.
        averages: Names of the other quantities.
        hidden_at_zero: Those that have no row if they are 0 in all runs.
        unlisted: Those that have a row only if they are named.
        quantities: Names of the numbers of a run.
    """

    config: str
    mode: str
    iterations: Mapping[str, object]
    settings_hash: object
    file_hashes: Mapping[str, str]
    groups: Mapping[str, int]
    variables: tuple[tuple[str, str], ...]
    averages: tuple[str, ...]
    hidden_at_zero: frozenset[str]
    unlisted: frozenset[str]
    quantities: tuple[str, ...]

    @cached_property
    def values(self) -> str:
        """Key of the runs that are averaged."""
        return json.dumps([self.config, self.mode, self.iterations], sort_keys=True)

    @property
    def key(self) -> str:
        """The same text for equal conditions."""
        names = self.groups, self.variables, self.averages, self.quantities
        settings = self.config, self.mode, self.iterations, self.settings_hash, self.file_hashes
        return repr((settings, names))

    @cached_property
    def positions(self) -> Mapping[str, int]:
        """Position of each quantity in `row`."""
        return {quantity: position for position, quantity in enumerate(self.quantities)}


@dataclass(frozen=True)
class RunSummary:
    """Summary of one run. A result file has all its nodes, and a study many result files.

    Attributes:
        row: Numbers of the run, one for each of `conditions.quantities`. For a tracked variable: the mean of
            a group, if it has one.
        left_out: Nodes by quantity and reason whose value of a tracked variable is not a finite number.
        directory: Directory of the result file, or the pack that it was read from.
        file_name: Name of the result file.
    """

    conditions: Conditions
    run: int
    seed: object
    row: tuple[float, ...]
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
        averages = list(averages_of(RunResult, result))
        numbers.update((average.name, average.value) for average in averages)
        conditions = Conditions(
            config=result["config"],
            mode=result["mode"],
            iterations=result["iterations"],
            settings_hash=result.get("settings_hash"),
            file_hashes=hashes if isinstance(hashes, dict) else {},
            groups={group: len(nodes) for group, nodes in groups.items()},
            variables=tuple(variables),
            averages=tuple(average.name for average in averages),
            hidden_at_zero=frozenset(each.name for each in averages if not each.shown_at_zero),
            unlisted=frozenset(each.name for each in averages if not each.listed),
            quantities=tuple(numbers),
        )
        seed, row = result.get("seed"), tuple(numbers.values())
        return cls(conditions, result["run"], seed, row, left_out, file.parent, file.name)

    @property
    def config(self) -> str:
        """Name of the configuration."""
        return self.conditions.config

    @property
    def mode(self) -> str:
        """Mode of the run."""
        return self.conditions.mode

    @property
    def iterations(self) -> Mapping[str, object]:
        """Value of each iteration variable."""
        return self.conditions.iterations

    @property
    def settings_hash(self) -> object:
        """Hash of its settings."""
        return self.conditions.settings_hash

    @property
    def numbers(self) -> dict[str, float]:
        """Numbers of the run by quantity. For a tracked variable: the mean of a group, if it has one."""
        return dict(zip(self.conditions.quantities, self.row, strict=True))

    def number(self, quantity: str) -> float | None:
        """Return a number of the run, if it has that quantity."""
        position = self.conditions.positions.get(quantity)
        return None if position is None else self.row[position]

    def is_binary(self, quantity: str) -> bool:
        """Return whether a tracked variable is 0 or 1, or missing.

        Other quantities are shares of many frames or messages. A share of 1 in each run is more than a yes.
        """
        return self.number(quantity) in (None, 0, 1) and quantity not in self.conditions.averages

    @property
    def file(self) -> Path:
        """The result file. `read_run_file` also finds it in a pack."""
        return self.directory / self.file_name

    def view(self, height_px: int = HEIGHT_PX) -> ReplayView:
        """Return the replay next to the result file, which a notebook shows.

        Raises OSError if the run was not recorded.
        """
        return ReplayView(self.file.with_suffix(".html").read_text(encoding="utf-8"), height_px)

    @property
    def name(self) -> str:
        """Name for messages."""
        return f"{self.config}-#{self.run}"


def in_order(summaries: Iterable[RunSummary]) -> list[RunSummary]:
    """Return summaries sorted by configuration, mode and run. `Field5` comes before `Field15`."""
    summaries = list(summaries)
    configs = sorted({summary.config for summary in summaries}, key=_natural)
    ranks = {config: rank for rank, config in enumerate(configs)}
    return sorted(summaries, key=lambda summary: (ranks[summary.config], summary.mode, summary.run))


def _natural(name: str) -> tuple[list[str], list[int]]:
    return re.split(r"\d+", name), [int(digits) for digits in re.findall(r"\d+", name)]
