"""Conversions between decibels and linear quantities, as in `cpp/netsim/units.hpp`. 0 dBm is 1 mW."""

import math


def ratio_from_db(ratio_db: float) -> float:
    """10^(dB/10). OverflowError if no double is as large."""
    return math.pow(10.0, ratio_db / 10.0)


def db_from_ratio(ratio: float) -> float:
    """10 log10(ratio); 0 gives minus infinity."""
    return 10.0 * math.log10(ratio) if ratio > 0 else -math.inf


def dbm_from_w(power_w: float) -> float:
    """0 W gives minus infinity."""
    return db_from_ratio(power_w * 1000.0)
