"""Transmission powers of interfaces that have a range instead."""

import math
from typing import TYPE_CHECKING

from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.engine_errors import text_of
from gradysim.integrated.two_ray_ground import ground_hint
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.node_spec import InterfaceSpec, NodeSpec
from gradysim.scenario.schema.keys import DEFAULT_INTERFACE, has_radios

if TYPE_CHECKING:
    from gradysim._netsim import LinkBudget, MediumConfig, NodeConfig

RATIO = 0.5
MESSAGE_BYTES = 50
"""Meaning of a range without further settings: half of the broadcast messages of this length arrive."""

_LEAST_MTU_BYTES = MESSAGE_BYTES + 28
"""With the headers of IPv4 and UDP."""

_NEAREST_M, _FARTHEST_M = 1e-3, 1e9
_STEPS = 60
"""Halvings of the logarithmic interval of distances; the last one is about as wide as a float is accurate."""


def range_of(budget: "LinkBudget", tx_power_w: float) -> float:
    """Return the largest distance at which half of the frames arrive. The ratio falls with the distance."""
    near, far = math.log(_NEAREST_M), math.log(_FARTHEST_M)
    for _ in range(_STEPS):
        middle = (near + far) / 2
        if budget.reception_ratio(math.exp(middle), tx_power_w) >= RATIO:
            near = middle
        else:
            far = middle
    return math.exp(near)


class PowersForRanges:
    """Computes each power once, for all nodes that have it.

    It is the power that `gradysim calibrate` prints.
    """

    def __init__(self, medium: "MediumConfig") -> None:
        """Compute powers in this medium."""
        self._medium = medium
        self._has_powers = has_radios(medium.typename)
        self._known: dict[object, float] = {}

    def set_powers(self, config: "NodeConfig", spec: NodeSpec) -> None:
        """Set the powers with which a copy of this node, at the same height, is at the end of the range.

        Only for interfaces that have a range. A medium that uses the range itself needs no powers. Raises
        ConfigError, at the line of the range, if no power is sufficient.
        """
        if not self._has_powers:
            return
        for index, wlan in enumerate(spec.wlan):
            if wlan.range_sets_power:
                config.wlan[index].radio.tx_power_w = self._power_w(config, spec, index)

    def _power_w(self, config: "NodeConfig", spec: NodeSpec, index: int) -> float:
        wlan = spec.wlan[index]
        # Interfaces with the same effective lines share their specification.
        key = (id(wlan), config.initial_position[2])
        power_w = self._known.get(key)
        if power_w is None:
            mtu = wlan.mac.get("mtu_bytes")
            is_80211 = config.wlan[index].typename == DEFAULT_INTERFACE
            if mtu is not None and is_80211 and int(mtu.value) < _LEAST_MTU_BYTES:
                text = (
                    f"expected at least {_LEAST_MTU_BYTES}B: transmitter.communicationRange is about messages"
                    f" of {MESSAGE_BYTES}B, which have {_LEAST_MTU_BYTES - MESSAGE_BYTES}B of headers"
                )
                raise ConfigError.at(mtu.source, text)
            budget = load_netsim().LinkBudget(self._medium, config, config, MESSAGE_BYTES, index)
            self._check_bitrate(budget.bitrate_bps, config, wlan, index)
            hint = ground_hint(self._medium, [spec])
            try:
                power_w = budget.tx_power_w_for(config.wlan[index].radio.communication_range_m, RATIO)
            except load_netsim().ConfigError as error:
                text = text_of(error) + (f"; {hint}" if hint else "")
                raise ConfigError.at(wlan.radio["communication_range_m"].source, text) from error
            self._known[key] = power_w
        return power_w

    def _check_bitrate(
        self, bitrate_bps: float, config: "NodeConfig", wlan: InterfaceSpec, index: int
    ) -> None:
        """Raise ConfigError if the power that a range sets is not that of broadcasts."""
        if bitrate_bps in dict(config.wlan[index].radio.tx_power_by_bitrate_w):
            text = (
                f"broadcasts have {bitrate_bps / 1e6:g} Mbps, whose power is that of"
                " transmitter.powerByBitrate, so that no range sets it"
            )
            raise ConfigError.at(
                wlan.radio["communication_range_m"].source,
                text,
                expected="powerByBitrate without this bitrate, or no range",
            )
