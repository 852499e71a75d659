"""Tracked variables: as scalars, and by groups of nodes for means over runs."""

import math
import re
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from typing import Any, NamedTuple

from gradysim.protocol.plain_value import as_float, key_text
from gradysim.results.confidence_interval import mean_of
from gradysim.results.quantity import Scalar, recorded

Tracked = Mapping[str, Any]
"""{name: value} at one node, as JSON objects have them."""


REASONS = ("nan or None", "inf", "-inf", "too large", "no number", "missing")
"""What a variable is at a node if it is not a finite number. JSON objects do not distinguish NaN and None."""

_NUMBERS = {"inf", "-inf", "too large"}
"""Numbers that have no part in a mean."""


def tracked_scalars(tracked: Mapping[str, object], node: str) -> Iterator[Scalar]:
    """Yield `heard:last` and so on, of the variables that are numbers."""
    for name, value in tracked.items():
        if (number := as_float(value)) is not None:
            yield recorded(f"{node}.protocol", f"{key_text(name)}:last", number)


class TrackedVariable(NamedTuple):
    """A tracked variable at the nodes of a group.

    Attributes:
        mean: Of the finite numbers; None if no node has one.
        others: {what it is instead: number of nodes}.
    """

    mean: float | None
    others: Mapping[str, int]

    @property
    def is_numeric(self) -> bool:
        """Whether it is a number at any node, even if only an infinite one."""
        return self.mean is not None or not _NUMBERS.isdisjoint(self.others)


def variables_of_group(nodes: list[Tracked]) -> dict[str, TrackedVariable]:
    """Return the tracked variables at the nodes of a group, by name."""
    variables = {}
    for name in dict.fromkeys(name for tracked in nodes for name in tracked):
        numbers, others = numbers_and_others(nodes, name)
        variables[name] = TrackedVariable(
            mean_of(numbers) if numbers else None, Counter(others) if others else {}
        )
    return variables


def tracked_by_group(nodes: Iterable[Mapping[str, Any]]) -> dict[str, list[Tracked]]:
    """Return {`uavs[*]`: the variables of each of its nodes} for the nodes of a JSON object."""
    groups: dict[str, list[Tracked]] = {}
    for node in nodes:
        groups.setdefault(group_of(node["name"]), []).append(node["tracked_variables"])
    return groups


@cache
def group_of(node: str) -> str:
    """Return `uavs[*]` for `uavs[0]`; the name itself if it has no index."""
    return re.sub(r"\[\d+\]$", "[*]", node)


def numbers_and_others(nodes: Iterable[Tracked], name: str) -> tuple[list[float], list[str]]:
    """Return the finite numbers of the variable `name` at `nodes`, and what it is at the others.

    These are `REASONS`: "too large" is too large for a float, and "missing" a node without the variable.
    """
    numbers: list[float] = []
    others: list[str] = []
    for tracked in nodes:
        what = _not_finite(tracked[name]) if name in tracked else "missing"
        if what is None:
            numbers.append(tracked[name])
        else:
            others.append(what)
    return numbers, others


def _not_finite(value: object) -> str | None:
    """Return what `value` is; None for a finite number."""
    if value in ("inf", "-inf"):
        return str(value)
    if value is None:
        return "nan or None"
    if not isinstance(value, int | float):
        return "no number"
    if isinstance(value, int):
        return "too large" if abs(value) > sys.float_info.max else None
    if math.isnan(value):
        return "nan or None"
    return None if math.isfinite(value) else str(value)
