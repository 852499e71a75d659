"""Keys of a node's antenna. The names are INET's, and those of its AttachedMobility for how it is mounted."""

from gradysim.scenario.keys.interface import WLAN
from gradysim.scenario.keys.key import HAS_TO_BE_GIVEN, Key
from gradysim.scenario.keys.radio_media import RADIO_MEDIA
from gradysim.scenario.keys.shapes import Below, angle
from gradysim.scenario.parameter_types import choice, power_ratio, quantity

_own = Below(f"{WLAN}.radio.antenna", "antenna", RADIO_MEDIA)
_constant = _own.only_for("antenna.typename", "ConstantGainAntenna")
_dipole = _own.only_for("antenna.typename", "DipoleAntenna")
_beam = _own.only_for("antenna.typename", "CosineAntenna", "ParabolicAntenna")
_parabolic = _own.only_for("antenna.typename", "ParabolicAntenna")
_mounted = _own.only_for("antenna.typename", "DipoleAntenna", "CosineAntenna", "ParabolicAntenna", shown="")

ANTENNA_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "typename",
        choice(
            "IsotropicAntenna", "ConstantGainAntenna", "DipoleAntenna", "CosineAntenna", "ParabolicAntenna"
        ),
        "Where the antenna sends to and receives from",
    ),
    _constant("gain", "gain", power_ratio(), "gain in all directions"),
    _beam(
        "maxGain",
        "max_gain",
        power_ratio(),
        "gain along the boresight, its x axis",
    ),
    _parabolic("minGain", "min_gain", power_ratio(), "gain outside of the beam"),
    _beam(
        "beamWidth",
        "beam_width_rad",
        quantity("rad", above=0, shown="deg"),
        "angle between the directions at half the power",
        default=HAS_TO_BE_GIVEN,
    ),
    _dipole("wireAxis", "wire_axis", choice("x", "y", "z"), "the axis along which it lies"),
    _dipole(
        "length",
        "length_m",
        quantity("m", at_least=0),
        "from end to end, up to one wavelength; 0m: much shorter than the wave",
    ),
    _mounted(
        "offsetHeading",
        "offset_heading_rad",
        angle(),
        "How the antenna is turned on the node: from the node's x towards its y",
    ),
    _mounted("offsetElevation", "offset_elevation_rad", angle(), "The same upwards: -90deg looks down"),
    _mounted("offsetBank", "offset_bank_rad", angle(), "The same about the antenna's own x axis"),
)
