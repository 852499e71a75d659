"""Keys of the air: its model, its noise, and how frames travel through it."""

from gradysim.config.key import Key
from gradysim.config.keys.path_loss import PATH_LOSS_KEYS
from gradysim.config.keys.shapes import Below
from gradysim.config.kinds import choice, quantity

_own = Below("radioMedium", "medium")
_noise = Below("radioMedium.backgroundNoise", "medium")

MEDIUM_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "typename",
        choice("Ieee80211ScalarRadioMedium", "Ieee802154NarrowbandScalarRadioMedium", "UnitDiskRadioMedium"),
        "The model of the air: path loss and noise, or a circle",
    ),
    _noise(
        "typename",
        "background_noise",
        choice("IsotropicScalarBackgroundNoise", "ThermalNoise"),
        "The noise in a channel: one power for all, or that of the receiver's bandwidth",
    ),
    _noise(
        "power",
        "background_noise_w",
        quantity("W", at_least=0, shown="dBm"),
        "IsotropicScalarBackgroundNoise: noise in the channel",
    ),
    _noise(
        "temperature",
        "temperature_k",
        quantity("K", at_least=0),
        "ThermalNoise: temperature of the receiver's surroundings",
    ),
    *PATH_LOSS_KEYS,
    _own(
        "propagation.typename",
        "propagation",
        choice("ConstantSpeedPropagation"),
        "How frames travel: with the speed of light",
    ),
)
