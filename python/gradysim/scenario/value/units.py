"""The units of .ini files, by OMNeT++'s names: `d` is a day, `m` a metre, `min` a minute, `B` is eight `b`.

`dB` stays a number with the unit dB, since models disagree about what it is a ratio of; `dBm` and `dBW` are
powers.
"""

import math
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

from gradysim.scenario.errors import BadValue, nearest


class Dimension(Enum):
    """What a unit measures. The value names it in messages, with an example."""

    TIME = "a time such as 10s"
    LENGTH = "a length such as 50m"
    SPEED = "a speed such as 10mps"
    POWER = "a power such as 20mW or -85dBm"
    FREQUENCY = "a frequency such as 2.4GHz"
    BITRATE = "a bitrate such as 24Mbps"
    DATA = "a size such as 100B"
    ANGLE = "an angle such as 90deg"
    LEVEL = "a ratio in decibels such as 4dB"
    RATIO = "a plain number"
    ENERGY = "an energy such as 10J"
    VOLTAGE = "a voltage such as 12V"
    CURRENT = "a current such as 2A"
    MASS = "a mass such as 2kg"
    TEMPERATURE = "a temperature such as 290K"


@dataclass(frozen=True)
class Unit:
    """A unit. `value` in it is `value * factor` in the SI unit of its dimension.

    A logarithmic unit is `factor * 10 ** (value / 10)` in it instead.
    """

    name: str
    dimension: Dimension
    factor: Fraction
    logarithmic: bool = False


_LINEAR: dict[Dimension, dict[str, Fraction | int | str]] = {
    Dimension.TIME: {
        "s": 1, "d": 86400, "h": 3600, "min": 60, "ms": "1e-3", "us": "1e-6", "ns": "1e-9", "ps": "1e-12",
        "fs": "1e-15", "as": "1e-18",
    },
    Dimension.LENGTH: {"m": 1, "km": 1000, "cm": "1e-2", "mm": "1e-3", "um": "1e-6", "nm": "1e-9"},
    Dimension.SPEED: {"mps": 1, "kmps": 1000, "kmph": Fraction(5, 18), "cmps": "1e-2", "mmps": "1e-3"},
    Dimension.POWER: {
        "W": 1, "GW": "1e9", "MW": "1e6", "kW": 1000, "mW": "1e-3", "uW": "1e-6", "nW": "1e-9", "pW": "1e-12",
        "fW": "1e-15",
    },
    Dimension.FREQUENCY: {"Hz": 1, "kHz": 1000, "MHz": "1e6", "GHz": "1e9", "THz": "1e12"},
    Dimension.BITRATE: {
        "bps": 1, "kbps": 1000, "Mbps": "1e6", "Gbps": "1e9", "Bps": 8, "kBps": 8000, "MBps": "8e6",
        "GBps": "8e9",
    },
    Dimension.DATA: {
        "b": 1, "bit": 1, "kb": 1000, "Mb": "1e6", "Gb": "1e9", "Kib": 2**10, "Mib": 2**20, "Gib": 2**30,
        "B": 8, "byte": 8, "Byte": 8, "kB": 8000, "MB": "8e6", "GB": "8e9", "KiB": 2**13, "MiB": 2**23,
        "GiB": 2**33,
    },
    Dimension.ANGLE: {"rad": 1, "deg": Fraction(math.pi) / 180},
    Dimension.LEVEL: {"dB": 1},
    Dimension.RATIO: {"x": 1},
    Dimension.ENERGY: {"J": 1, "kJ": 1000, "MJ": "1e6", "mJ": "1e-3", "Wh": 3600, "kWh": 3600000},
    Dimension.VOLTAGE: {"V": 1, "mV": "1e-3"},
    Dimension.CURRENT: {"A": 1, "mA": "1e-3", "uA": "1e-6"},
    Dimension.MASS: {"kg": 1, "g": "1e-3"},
    Dimension.TEMPERATURE: {"K": 1},
}  # fmt: skip

UNITS: dict[str, Unit] = {
    name: Unit(name, dimension, Fraction(factor))
    for dimension, factors in _LINEAR.items()
    for name, factor in factors.items()
} | {
    name: Unit(name, Dimension.POWER, Fraction(factor), logarithmic=True)
    for name, factor in {"dBW": "1", "dBm": "1e-3", "dBmW": "1e-3"}.items()
}

UNITS_IN_NAMES = (
    "s", "ms", "us", "m", "km", "mps", "kmph", "Hz", "kHz", "MHz", "GHz", "bps", "kbps", "Mbps", "rad", "deg",
    "W", "mW", "dBm", "dBW", "dB",
)  # fmt: skip
"""Those that the end of the name of a protocol's parameter may say, in small letters."""


def unit_named(name: str) -> Unit:
    """The unit of that name.

    Raises:
        BadValue: There is none; the message names the nearest.
    """
    unit = UNITS.get(name)
    if unit is None:
        raise BadValue(f"there is no unit `{name}`", suggestion=nearest(name, UNITS))
    return unit
