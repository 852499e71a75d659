"""Keys of a node's antenna. The names are INET's, and those of its AttachedMobility for how it is mounted."""

from gradysim.config.key import Key
from gradysim.config.keys.interface import WLAN
from gradysim.config.keys.shapes import Below, angle
from gradysim.config.kinds import choice, power_ratio, quantity

_own = Below(f"{WLAN}.radio.antenna", "antenna")

ANTENNA_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "typename",
        choice(
            "IsotropicAntenna", "ConstantGainAntenna", "DipoleAntenna", "CosineAntenna", "ParabolicAntenna"
        ),
        "Where the antenna sends to and receives from",
    ),
    _own("gain", "gain", power_ratio(), "ConstantGainAntenna: gain in all directions"),
    _own(
        "maxGain",
        "max_gain",
        power_ratio(),
        "CosineAntenna, ParabolicAntenna: gain along the boresight, its x axis",
    ),
    _own("minGain", "min_gain", power_ratio(), "ParabolicAntenna: gain outside of the beam"),
    _own(
        "beamWidth",
        "beam_width_rad",
        quantity("rad", above=0, shown="deg"),
        "CosineAntenna, ParabolicAntenna: angle between the directions at half the power; has to be given",
    ),
    _own("wireAxis", "wire_axis", choice("x", "y", "z"), "DipoleAntenna: the axis along which it lies"),
    _own(
        "length",
        "length_m",
        quantity("m", at_least=0),
        "DipoleAntenna: from end to end, up to one wavelength; 0m: much shorter than the wave",
    ),
    _own(
        "offsetHeading",
        "offset_heading_rad",
        angle(),
        "How the antenna is turned on the node: from the node's x towards its y",
    ),
    _own("offsetElevation", "offset_elevation_rad", angle(), "The same upwards: -90deg looks down"),
    _own("offsetBank", "offset_bank_rad", angle(), "The same about the antenna's own x axis"),
)
