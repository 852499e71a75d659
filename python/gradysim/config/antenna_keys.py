"""Keys of a node's antenna. The names are INET's, and those of its AttachedMobility for how it is mounted."""

from gradysim.config.key import Key
from gradysim.config.kinds import choice, power_ratio, quantity

_ANTENNA = "wlan[0].radio.antenna"

ANTENNA_KEYS: tuple[Key, ...] = (
    Key(
        f"{_ANTENNA}.typename",
        "antenna.typename",
        choice(
            "IsotropicAntenna", "ConstantGainAntenna", "DipoleAntenna", "CosineAntenna", "ParabolicAntenna"
        ),
        "Where the antenna sends to and receives from",
    ),
    Key(
        f"{_ANTENNA}.gain",
        "antenna.gain",
        power_ratio(),
        "ConstantGainAntenna: gain in all directions",
    ),
    Key(
        f"{_ANTENNA}.maxGain",
        "antenna.max_gain",
        power_ratio(),
        "CosineAntenna, ParabolicAntenna: gain along the boresight, its x axis",
    ),
    Key(
        f"{_ANTENNA}.minGain",
        "antenna.min_gain",
        power_ratio(),
        "ParabolicAntenna: gain outside of the beam",
    ),
    Key(
        f"{_ANTENNA}.beamWidth",
        "antenna.beam_width_rad",
        quantity("rad", above=0, shown="deg"),
        "CosineAntenna, ParabolicAntenna: angle between the directions at half the power; has to be given",
    ),
    Key(
        f"{_ANTENNA}.wireAxis",
        "antenna.wire_axis",
        choice("x", "y", "z"),
        "DipoleAntenna: the axis along which it lies",
    ),
    Key(
        f"{_ANTENNA}.length",
        "antenna.length_m",
        quantity("m", at_least=0),
        "DipoleAntenna: from end to end, up to one wavelength; 0m: much shorter than the wave",
    ),
    Key(
        f"{_ANTENNA}.offsetHeading",
        "antenna.offset_heading_rad",
        quantity("rad", shown="deg"),
        "How the antenna is turned on the node: from the node's x towards its y",
    ),
    Key(
        f"{_ANTENNA}.offsetElevation",
        "antenna.offset_elevation_rad",
        quantity("rad", shown="deg"),
        "The same upwards: -90deg looks down",
    ),
    Key(
        f"{_ANTENNA}.offsetBank",
        "antenna.offset_bank_rad",
        quantity("rad", shown="deg"),
        "The same about the antenna's own x axis",
    ),
)
