"""Mean values over the runs of a study, from the files that `--result-dir` holds."""

import json
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import fmean
from typing import Any

from gradysim.results.student import mean_with_half_width

_FIELDS = {"config", "mode", "run", "interrupted", "fates", "nodes", "iterations"}
"""What tells a result of a run from other files."""


@dataclass(frozen=True)
class Mean:
    """One quantity of the runs with the same values of iteration variables."""

    config: str
    mode: str
    iterations: Mapping[str, object]
    """{name: value}, as the results have it."""
    quantity: str
    """`uavs[*] heard`: a tracked variable, the mean of a group's nodes; `broadcast delivered`: a share."""
    runs: int
    mean: float
    half_width: float | None
    """Of the 95 % confidence interval; None for a single run."""


def read_results(directory: Path) -> list[dict[str, Any]]:
    """Return the results in the files of a folder, in the order of configurations and runs.

    Files of other kinds, and runs that were interrupted, are left out. Raises OSError.
    """
    results = []
    for file in sorted(directory.iterdir()):
        if file.suffix == ".json" and file.is_file():
            try:
                result = json.loads(file.read_text(encoding="utf-8"))
            except (ValueError, RecursionError):  # no JSON, or too deep
                continue
            if isinstance(result, dict) and result.keys() >= _FIELDS and not result["interrupted"]:
                results.append(result)
    return sorted(results, key=lambda result: (result["config"], result["mode"], result["run"]))


def means(results: Iterable[Mapping[str, Any]]) -> list[Mean]:
    """Return the mean of each quantity over the runs that have equal values of iteration variables."""
    alike: dict[str, list[Mapping[str, Any]]] = {}
    for result in results:
        alike.setdefault(_values_of(result), []).append(result)
    return [mean for runs in alike.values() for mean in _means_of(runs)]


def of_different_settings(results: Iterable[Mapping[str, Any]]) -> tuple[str, str] | None:
    """Name two of the runs with equal values of variables, if there are any whose settings differ."""
    first: dict[str, Mapping[str, Any]] = {}
    for result in results:
        other = first.setdefault(_values_of(result), result)
        if other.get("settings_hash") != result.get("settings_hash"):
            return _name(other), _name(result)
    return None


def of_different_files(results: Iterable[Mapping[str, Any]]) -> tuple[str, str, str] | None:
    """Name two runs of one configuration, and a file of that name that differs between them, if there is one.

    They may be of different values: these are there to be compared.
    """
    first: dict[tuple[str, str], tuple[str, Mapping[str, Any]]] = {}
    for result in results:
        hashes = result.get("file_hashes")
        for name, file_hash in hashes.items() if isinstance(hashes, dict) else ():
            known, other = first.setdefault((result["config"], name), (file_hash, result))
            if known != file_hash:
                one, another = (f"{_name(each)}.{each['mode']}" for each in (other, result))
                return one, another, name
    return None


def _name(result: Mapping[str, Any]) -> str:
    return f"{result['config']}-#{result['run']}"


def _values_of(result: Mapping[str, Any]) -> str:
    return json.dumps([result["config"], result["mode"], result["iterations"]], sort_keys=True)


def _means_of(runs: list[Mapping[str, Any]]) -> Iterator[Mean]:
    values: dict[str, list[float]] = {}
    for run in runs:
        for quantity, value in (*_tracked(run["nodes"]), *_delivered(run["fates"])):
            values.setdefault(quantity, []).append(value)
    for quantity, of_runs in values.items():
        mean, half_width = mean_with_half_width(of_runs)
        first = runs[0]
        yield Mean(
            first["config"], first["mode"], first["iterations"], quantity, len(of_runs), mean, half_width
        )


def _tracked(nodes: Iterable[Mapping[str, Any]]) -> Iterator[tuple[str, float]]:
    """The mean over a group's nodes of each tracked variable that is a number."""
    values: dict[str, list[float]] = {}
    for node in nodes:
        group = re.sub(r"\[\d+\]$", "[*]", node["name"])
        for name, value in node["tracked_variables"].items():
            if isinstance(value, int | float) and abs(value) <= sys.float_info.max:
                values.setdefault(f"{group} {name}", []).append(value)
    for quantity, of_nodes in values.items():
        yield quantity, fmean(of_nodes)


def _delivered(fates: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    """The share that was delivered of the copies for a receiver whose fate was known at the end."""
    for kind, counts in (fates.get("frames") or fates.get("copies") or {}).items():
        decided = sum(counts.values()) - counts.get("in_air", 0)
        if decided > 0 and not kind.endswith(" overheard"):
            yield f"{kind} delivered", counts.get("delivered", 0) / decided
