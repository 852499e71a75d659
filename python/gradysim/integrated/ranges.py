"""How far the radios of a scenario reach, and whether prototype mode has the same range."""

import contextlib
import math
from collections.abc import Callable, Iterable, Iterator
from itertools import chain
from typing import TYPE_CHECKING, TypeVar

from gradysim.integrated.compiled_part import CompiledPartMissingError, load_netsim
from gradysim.integrated.network import medium_config, node_config
from gradysim.integrated.power_for_range import MESSAGE_BYTES, PowersForRanges, range_of
from gradysim.replay.description import FarLoss
from gradysim.scenario.lint import Finding, by_line
from gradysim.scenario.ranges import are_alike, ranges_of_prototype_m
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.keys import PATH_LOSS_EFFECTS, has_radios

if TYPE_CHECKING:
    from gradysim._netsim import LinkBudget, RadioConfig

Value = TypeVar("Value")

_FAR_M = (1e5, 1e6)
"""Distances beyond any change of the exponent, in meters."""

_DBM_PER_DBW = 30


def ranges_m(scenario: Scenario) -> list[float | None]:
    """Return the distance (m) at which half of the messages of each node arrive, without other senders.

    Between nodes like this one, over wlan[0]. None if the engine cannot compute it.
    """

    def range_m(radio: "RadioConfig", budget: "LinkBudget | None") -> float | None:
        return radio.communication_range_m if budget is None else range_of(budget, budget.tx_power_w)

    return _of_each_radio(scenario, range_m)


def far_losses(scenario: Scenario) -> list[FarLoss | None]:
    """Return the path loss of each node's wlan[0] far away; None if it is not a power of the distance."""
    medium = medium_config(scenario)
    random_losses = (*PATH_LOSS_EFFECTS["shadowing"], *PATH_LOSS_EFFECTS["fading"])
    is_random = medium.path_loss in random_losses or medium.shadowing_standard_deviation_db > 0

    def far_loss(radio: "RadioConfig", budget: "LinkBudget | None") -> FarLoss | None:
        if budget is None or medium.path_loss in PATH_LOSS_EFFECTS["ground"]:
            return None
        near_db, far_db = (-10 * math.log10(budget.mean_gain(distance_m)) for distance_m in _FAR_M)
        exponent = (far_db - near_db) / 10
        return FarLoss(
            10 * math.log10(radio.sensitivity_w) + _DBM_PER_DBW,
            near_db - 10 * exponent * math.log10(_FAR_M[0]),
            exponent,
            is_random or radio.antenna.typename != "IsotropicAntenna",
        )

    return _of_each_radio(scenario, far_loss)


def _of_each_radio(
    scenario: Scenario, compute: "Callable[[RadioConfig, LinkBudget | None], Value | None]"
) -> "list[Value | None]":
    """Return a number of the wlan[0] of each node: None if the message of a range does not fit into a frame.

    `compute` takes the radio and the link between two nodes like this one; None on a medium without powers.
    """
    netsim = load_netsim()
    medium = medium_config(scenario)
    powers = PowersForRanges(medium)
    known: dict[object, Value | None] = {}
    for spec in scenario.nodes:
        key = (id(spec.wlan[0]), spec.initial_position[2])
        if key in known:
            continue
        config = node_config(spec)
        radio = config.wlan[0].radio
        if not has_radios(medium.typename):
            known[key] = compute(radio, None)
            continue
        powers.set_powers(config, spec)
        try:
            budget = netsim.LinkBudget(medium, config, config, MESSAGE_BYTES, 0)
        except netsim.ConfigError:
            known[key] = None
        else:
            known[key] = compute(radio, budget)
    return [known[id(spec.wlan[0]), spec.initial_position[2]] for spec in scenario.nodes]


def lint_ranges(scenarios: Iterable[Scenario], mode: str) -> list[Finding]:
    """Return a finding for each line that gives the two modes different ranges.

    A power leaves prototype mode its default range, which is of interest in that mode only. Without the
    engine there is one mode, and no finding.
    """
    different = {(id(scenario.nodes), id(scenario.medium)): scenario for scenario in scenarios}
    with contextlib.suppress(CompiledPartMissingError):
        return by_line(chain.from_iterable(_differing(scenario, mode) for scenario in different.values()))
    return []


def _differing(scenario: Scenario, mode: str) -> Iterator[Finding]:
    given = scenario.communication_medium.range_source
    powers = [spec.wlan[0].radio.get("tx_power_w") for spec in scenario.nodes]
    if given is None and (mode == "integrated" or not any(powers)):
        return
    pairs = zip(scenario.nodes, powers, ranges_of_prototype_m(scenario), ranges_m(scenario), strict=True)
    for spec, power, prototype_m, radio_m in pairs:
        if radio_m is None or are_alike(prototype_m, radio_m):
            continue
        source = given or (power or next(filter(None, powers))).source
        yield Finding(
            source,
            f"{spec.name} reaches {_shown(prototype_m)} in prototype mode, and {_shown(radio_m)} in"
            " integrated mode; expected one range for both, `wlan[*].radio.transmitter.communicationRange`,"
            f" without {'a transmissionRange' if given else 'a power'}",
        )
        return


def _shown(range_m: float) -> str:
    return f"{range_m:.4g} m" if math.isfinite(range_m) else "any distance"
