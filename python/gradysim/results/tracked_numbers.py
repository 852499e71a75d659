"""Tracked variables by groups of nodes: which are numbers, and what is none among their values."""

import math
import re
import sys
from collections.abc import Iterable, Mapping
from typing import Any

Tracked = Mapping[str, Any]
"""The tracked variables of one node, as results have them."""


def tracked_by_group(nodes: Iterable[Mapping[str, Any]]) -> dict[str, list[Tracked]]:
    """Return {`uavs[*]`: the variables of each of its nodes} for the nodes of a result."""
    groups: dict[str, list[Tracked]] = {}
    for node in nodes:
        groups.setdefault(re.sub(r"\[\d+\]$", "[*]", node["name"]), []).append(node["tracked_variables"])
    return groups


def numeric_variables(groups: Mapping[str, Iterable[Tracked]]) -> dict[tuple[str, str], None]:
    """Return (group, name) of each variable that is a number, if only an infinite one, at any node."""
    return {
        (group, name): None
        for group, nodes in groups.items()
        for tracked in nodes
        for name in tracked
        if _not_finite(tracked[name]) in (None, "inf", "-inf", "too large")
    }


def numbers_and_others(nodes: Iterable[Tracked], name: str) -> tuple[list[float], list[str]]:
    """Return the finite numbers that the variable `name` is at `nodes`, and what it is at the others.

    That is "inf", "-inf", "nan or None" (results do not tell these two apart), "too large" for a float,
    "no number", or "missing" where a node does not have the variable.
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
