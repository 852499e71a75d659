"""Keys of how an 802.11 interface chooses the rate of its unicast frames."""

from gradysim.scenario.keys.interface import IEEE80211, WLAN
from gradysim.scenario.keys.key import Key
from gradysim.scenario.keys.shapes import Below, bit_rate
from gradysim.scenario.parameter_types import choice, integer, number, quantity

_NAMES = ("ArfRateControl", "AarfRateControl", "MinstrelRateControl")

_own = Below(f"{WLAN}.mac.dcf.rateControl", "mac", IEEE80211)
_all = _own.only_for("mac.rate_control", *_NAMES, shown="")
_arf = _own.only_for("mac.rate_control", "ArfRateControl", "AarfRateControl", shown="ARF, AARF")
_aarf = _own.only_for("mac.rate_control", "AarfRateControl", shown="AARF")
_minstrel = _own.only_for("mac.rate_control", "MinstrelRateControl", shown="Minstrel")

RATE_CONTROL_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "rate_control",
        choice("", *_NAMES),
        'How the rate of unicast frames follows the losses; "": not at all',
    ),
    _all(
        "initialRate",
        "initial_rate_bps",
        bit_rate(),
        "Rate of the first frame to a node; -1bps: that of data frames",
    ),
    _arf(
        "interval",
        "rate_interval_s",
        quantity("s", at_least=1e-6, shown="ms"),
        "time after the last change at which the next faster rate is tried",
    ),
    _arf(
        "increaseThreshold",
        "increase_threshold",
        integer(1),
        "successes in a row that lead to the next faster rate",
    ),
    _arf(
        "decreaseThreshold",
        "decrease_threshold",
        integer(1),
        "failures in a row that lead to the next slower rate",
    ),
    _aarf(
        "increaseThresholdFactor",
        "increase_threshold_factor",
        number(at_least=1),
        "by how much increaseThreshold grows when the faster rate fails at once",
    ),
    _aarf("maxIncreaseThreshold", "max_increase_threshold", integer(1), "up to where it grows"),
    _minstrel(
        "updateInterval",
        "rate_update_interval_s",
        quantity("s", at_least=1e-6, shown="ms"),
        "time from one choice of the best rates to the next",
    ),
    _minstrel(
        "lookAroundRate",
        "look_around_share",
        number(at_least=0, at_most=1),
        "part of the frames that try a rate drawn at random, 0 to 1",
    ),
    _minstrel(
        "ewmaWeight",
        "ewma_weight",
        number(at_least=0, at_most=0.999999),
        "weight of the past in the mean share of successes",
    ),
)
