"""Keys of the air: its model, its noise, and how frames travel through it."""

from gradysim.scenario.keys.key import Key
from gradysim.scenario.keys.path_loss import PATH_LOSS_KEYS
from gradysim.scenario.keys.radio_media import RADIO_MEDIA
from gradysim.scenario.keys.shapes import Below, level
from gradysim.scenario.parameter_types import choice, quantity

_own = Below("radioMedium", "medium")
_of_radios = Below("radioMedium", "medium", RADIO_MEDIA)
_noise = _of_radios.below("backgroundNoise")
_isotropic_noise = _noise.only_for("medium.background_noise", "IsotropicScalarBackgroundNoise")
_thermal_noise = _noise.only_for("medium.background_noise", "ThermalNoise")

MEDIUM_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "typename",
        choice(*RADIO_MEDIA.names, "UnitDiskRadioMedium"),
        "The model of the air: path loss and noise, or a circle",
    ),
    _noise(
        "typename",
        "background_noise",
        choice("IsotropicScalarBackgroundNoise", "ThermalNoise"),
        "The noise in a channel: one power for all, or that of the receiver's bandwidth",
    ),
    _isotropic_noise(
        "power",
        "background_noise_w",
        level(zero=True),
        "noise in the channel",
    ),
    _thermal_noise(
        "temperature",
        "temperature_k",
        quantity("K", at_least=0),
        "temperature of the receiver's surroundings",
    ),
    *PATH_LOSS_KEYS,
    _of_radios(
        "propagation.typename",
        "propagation",
        choice("ConstantSpeedPropagation"),
        "How frames travel: with the speed of light",
    ),
)
