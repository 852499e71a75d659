"""Keys of how power falls with distance, and how it fades."""

from gradysim.scenario.keys.key import Key
from gradysim.scenario.keys.radio_media import RADIO_MEDIA
from gradysim.scenario.keys.shapes import Below
from gradysim.scenario.parameter_types import choice, number, number_in, quantity

_NOT_OF_ALPHA = ("BreakpointPathLoss", "TwoRayInterference")
_FADING = ("LogNormalShadowing", "RayleighFading", "RicianFading", "NakagamiFading")
_NAMES = ("FreeSpacePathLoss", "BreakpointPathLoss", "TwoRayGroundReflection", "TwoRayInterference", *_FADING)

_own = Below("radioMedium.pathLoss", "medium", RADIO_MEDIA)
_power_law = _own.only_for(
    "medium.path_loss",
    *(name for name in _NAMES if name not in _NOT_OF_ALPHA),
    shown=f"All but {' and '.join(_NOT_OF_ALPHA)}",
)
_breakpoint = _own.only_for("medium.path_loss", "BreakpointPathLoss")
_two_ray = _own.only_for("medium.path_loss", "TwoRayInterference")
_shadowing = _own.only_for("medium.path_loss", "LogNormalShadowing")
_rician = _own.only_for("medium.path_loss", "RicianFading")
_nakagami = _own.only_for("medium.path_loss", "NakagamiFading")
_fading = _own.only_for("medium.path_loss", *_FADING, shown="Shadowing and fading")

PATH_LOSS_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "path_loss",
        choice(*_NAMES),
        "How power falls with distance, and how it fades; docs/guides/propagation.md",
    ),
    _power_law(
        "alpha",
        "alpha",
        number(above=0),
        "exponent of the distance",
    ),
    _breakpoint(
        "breakpointDistance",
        "breakpoint_distance_m",
        quantity("m", above=0),
        "distance at which the exponent changes",
    ),
    _breakpoint("l01", "l01_db", number_in("dB"), "loss at 1 m"),
    _breakpoint("l02", "l02_db", number_in("dB"), "loss at the breakpoint"),
    _breakpoint("alpha1", "alpha1", number(above=0), "exponent before the breakpoint"),
    _breakpoint("alpha2", "alpha2", number(above=0), "exponent behind the breakpoint"),
    _two_ray(
        "epsilon_r",
        "epsilon_r",
        number(at_least=1),
        "relative permittivity of the ground",
    ),
    _two_ray(
        "polarization",
        "polarization",
        choice("horizontal", "vertical"),
        "of the antennas",
    ),
    _shadowing(
        "sigma",
        "sigma_db",
        number(at_least=0),
        "standard deviation in dB, as a plain number",
    ),
    _rician("k", "k_db", quantity("dB"), "power of the line of sight over that of all other ways"),
    _nakagami(
        "shapeFactor",
        "shape_factor",
        number(at_least=0.5),
        "m; the less, the deeper the fades",
    ),
    _fading(
        "coherenceTime",
        "coherence_time_s",
        quantity("s", at_least=0, special=-1, shown="ms"),
        "time in which it changes; 0s: with each frame, as in INET; -1s: 5 ms, shadowing 1 s",
    ),
)
