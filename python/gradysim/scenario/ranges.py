"""The ranges of prototype mode: those of the radios, unless the file gives it one of its own."""

import math
from statistics import mean

from gradysim.protocol.defaults import TRANSMISSION_RANGE_M
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.keys import has_radios

_ALIKE = 0.1
"""Relative difference up to which two ranges are alike: a power that is rounded gives 50.2 m, not 50 m."""


def ranges_of_prototype_m(scenario: Scenario) -> list[float]:
    """Return the distance (m) up to which the messages of each node arrive in prototype mode."""
    given = scenario.communication_medium.transmission_range_m
    if given is not None:
        return [given] * len(scenario.nodes)
    medium = scenario.medium.get("typename")
    has_powers = medium is None or has_radios(medium.value)
    return [_of_radio_m(spec, has_powers=has_powers) for spec in scenario.nodes]


def _of_radio_m(spec: NodeSpec, *, has_powers: bool) -> float:
    wlan = spec.wlan[0]
    setting = wlan.radio.get("communication_range_m")
    if setting is None or (has_powers and not wlan.range_sets_power):
        return TRANSMISSION_RANGE_M
    return float(setting.value)


def are_alike(one_m: float, other_m: float) -> bool:
    """Return whether two ranges differ by no more than the rounding of a power."""
    return math.isclose(one_m, other_m, rel_tol=_ALIKE)


def mean_range_m(ranges_m: "list[float] | list[float | None]") -> float | None:
    """Return the mean of the ranges that are known and finite; None if there are none."""
    finite = [range_m for range_m in ranges_m if range_m is not None and math.isfinite(range_m)]
    return mean(finite) if finite else None  # exact: a sum could be infinite
