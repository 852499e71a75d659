"""Keys of how power falls with distance, and how it fades."""

from gradysim.config.key import Key
from gradysim.config.keys.shapes import Below
from gradysim.config.kinds import choice, number, quantity

_own = Below("radioMedium.pathLoss", "medium")

PATH_LOSS_KEYS: tuple[Key, ...] = (
    _own(
        "typename",
        "path_loss",
        choice(
            "FreeSpacePathLoss",
            "BreakpointPathLoss",
            "TwoRayGroundReflection",
            "TwoRayInterference",
            "LogNormalShadowing",
            "RayleighFading",
            "RicianFading",
            "NakagamiFading",
        ),
        "How power falls with distance, and how it fades; docs/guides/propagation.md",
    ),
    _own(
        "alpha",
        "alpha",
        number(above=0),
        "Exponent of the distance; all but BreakpointPathLoss and TwoRayInterference",
    ),
    _own(
        "breakpointDistance",
        "breakpoint_distance_m",
        quantity("m", above=0),
        "BreakpointPathLoss: distance at which the exponent changes",
    ),
    _own("l01", "l01_db", quantity("dB"), "BreakpointPathLoss: loss at 1 m"),
    _own("l02", "l02_db", quantity("dB"), "BreakpointPathLoss: loss at the breakpoint"),
    _own("alpha1", "alpha1", number(above=0), "BreakpointPathLoss: exponent before the breakpoint"),
    _own("alpha2", "alpha2", number(above=0), "BreakpointPathLoss: exponent behind the breakpoint"),
    _own(
        "epsilon_r",
        "epsilon_r",
        number(at_least=1),
        "TwoRayInterference: relative permittivity of the ground",
    ),
    _own(
        "polarization",
        "polarization",
        choice("horizontal", "vertical"),
        "TwoRayInterference: of the antennas",
    ),
    _own(
        "sigma",
        "sigma_db",
        number(at_least=0),
        "LogNormalShadowing: standard deviation in dB, as a plain number",
    ),
    _own("k", "k_db", quantity("dB"), "RicianFading: power of the line of sight over that of all other ways"),
    _own(
        "shapeFactor",
        "shape_factor",
        number(at_least=0.5),
        "NakagamiFading: m; the less, the deeper the fades",
    ),
    _own(
        "coherenceTime",
        "coherence_time_s",
        quantity("s", at_least=0, special=-1, shown="ms"),
        "Time in which fading changes; 0s: with each frame, as in INET; -1s: 5 ms, shadowing 1 s",
    ),
)
