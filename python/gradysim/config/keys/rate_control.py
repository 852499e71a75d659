"""Keys of how an 802.11 interface chooses the rate of its unicast frames."""

from gradysim.config.key import Key
from gradysim.config.keys.interface import WLAN
from gradysim.config.keys.shapes import Below, bit_rate
from gradysim.config.kinds import choice, integer, number, quantity

_own = Below(f"{WLAN}.mac.dcf.rateControl", "mac")

RATE_CONTROL_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "rate_control",
        choice("", "ArfRateControl", "AarfRateControl", "MinstrelRateControl"),
        'How the rate of unicast frames follows the losses; "": not at all',
    ),
    _own(
        "initialRate",
        "initial_rate_bps",
        bit_rate(),
        "Rate of the first frame to a node; -1bps: that of data frames",
    ),
    _own(
        "interval",
        "rate_interval_s",
        quantity("s", at_least=1e-6, shown="ms"),
        "ARF, AARF: time after the last change at which the next faster rate is tried",
    ),
    _own(
        "increaseThreshold",
        "increase_threshold",
        integer(1),
        "ARF, AARF: successes in a row that lead to the next faster rate",
    ),
    _own(
        "decreaseThreshold",
        "decrease_threshold",
        integer(1),
        "ARF, AARF: failures in a row that lead to the next slower rate",
    ),
    _own(
        "increaseThresholdFactor",
        "increase_threshold_factor",
        number(at_least=1),
        "AARF: by how much increaseThreshold grows when the faster rate fails at once",
    ),
    _own("maxIncreaseThreshold", "max_increase_threshold", integer(1), "AARF: up to where it grows"),
    _own(
        "updateInterval",
        "rate_update_interval_s",
        quantity("s", at_least=1e-6, shown="ms"),
        "Minstrel: time from one choice of the best rates to the next",
    ),
    _own(
        "lookAroundRate",
        "look_around_share",
        number(at_least=0, at_most=1),
        "Minstrel: part of the frames that try a rate drawn at random, 0 to 1",
    ),
    _own(
        "ewmaWeight",
        "ewma_weight",
        number(at_least=0, at_most=0.999999),
        "Minstrel: weight of the past in the mean share of successes",
    ),
)
