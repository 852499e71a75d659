"""Received power, against INET: path loss with a ground, antennas, obstacles, fading.

INET's figures are signal to noise ratios of frames, as gains; the first three are not random. Known
differences are tested, too (docs/how-to/choose-a-propagation-model.md): here a cosine antenna falls twice as
fast, in decibels, and INET multiplies powers by the Rayleigh model's amplitudes.
"""

from collections.abc import Callable
from functools import cache
from math import cos, dist, log10, radians, sin, sqrt

from verification.finding import Finding
from verification.reference_data import rows
from verification.sampling import fisher_p, least_p

CARRIER_HZ = 2.412e9
DRAWS = 20_000
SENDER = (0.0, 0.0, 10.0)
RECEIVER = (100.0, 0.0, 10.0)
"""Receiver of fading frames."""
Place = tuple[float, float, float]
Fields = dict[str, float | str]

PATH_LOSSES: dict[str, Fields] = {
    "FreeSpace3": {"path_loss": "FreeSpacePathLoss", "alpha": 3.0},
    "Breakpoint": {"path_loss": "BreakpointPathLoss"},
    "TwoRayGround": {"path_loss": "TwoRayGroundReflection"},
    "TwoRayInterferenceH": {"path_loss": "TwoRayInterference", "epsilon_r": 15.0},
    "TwoRayInterferenceV": {
        "path_loss": "TwoRayInterference",
        "epsilon_r": 15.0,
        "polarization": "vertical",
        "inet_vertical_sign": True,
    },
}
PARABOLIC: Fields = {
    "typename": "ParabolicAntenna",
    "max_gain": 10.0,
    "min_gain": 0.01,
    "beam_width_rad": radians(60),
}
ANTENNAS: dict[str, Fields] = {
    "Dipole": {"typename": "DipoleAntenna"},
    "DipoleY": {"typename": "DipoleAntenna", "wire_axis": "y"},
    "Parabolic": PARABOLIC,
    "ParabolicTurned": PARABOLIC,
}
TURNED = {"ParabolicTurned": (radians(40), radians(15))}
"""Heading and elevation of the sender, if not 0."""
HALF_DB = 10 * log10(2)
"""INET uses 3 dB for it."""
COSINE: Fields = {"typename": "CosineAntenna", "max_gain": 10.0, "beam_width_rad": radians(60)}
BOXES = (((20.0, -30.0), (35.0, 10.0), 20.0), ((-60.0, -10.0), (-40.0, 10.0), 10.5))
"""Two corners and the height of each; they stand on the ground."""
FADING: dict[str, Fields] = {
    "LogNormal": {"path_loss": "LogNormalShadowing", "sigma_db": 4.0},
    "Rayleigh": {"path_loss": "RayleighFading"},
    "Rician": {"path_loss": "RicianFading", "k_db": 6.0},
    "Nakagami": {"path_loss": "NakagamiFading", "shape_factor": 2.5},
}


def inet(case: str) -> list[tuple[Place, float]]:
    """Return the positions of receivers, and the gain from the sender to each."""
    return [
        ((float(row["x_m"]), float(row["y_m"]), float(row["z_m"])), float(row["gain"]))
        for row in rows("inet_propagation", case=case)
    ]


def path_gain(**fields: object) -> Callable[[Place], float]:
    """Return the gain from the sender, over a medium with these fields of its configuration."""
    from gradysim._netsim import MediumConfig, Propagation

    config = MediumConfig()
    for field, value in fields.items():
        setattr(config, field, value)
    propagation = Propagation(config, 1)
    return lambda place: propagation.gain(SENDER, place, CARRIER_HZ)


def pattern(fields: Fields, heading: float = 0.0, elevation: float = 0.0) -> Callable[[Place], float]:
    """Return the gain of the sender's antenna towards a place; the sender is turned by these angles."""
    from gradysim._netsim import AntennaConfig, antenna_gain

    config = AntennaConfig()
    for field, value in fields.items():
        setattr(config, field, value)

    def gain(place: Place) -> float:
        length = dist(place, SENDER)
        x, y, z = ((p - q) / length for p, q in zip(place, SENDER, strict=True))
        ahead, left = x * cos(heading) + y * sin(heading), y * cos(heading) - x * sin(heading)
        own = (
            ahead * cos(elevation) + z * sin(elevation),
            left,
            z * cos(elevation) - ahead * sin(elevation),
        )
        return antenna_gain(config, CARRIER_HZ, own)

    return gain


def test_path_losses_are_inets(report: Callable[[Finding], None]) -> None:
    off = [
        abs(path_gain(**fields)(place) / gain - 1)
        for case, fields in PATH_LOSSES.items()
        for place, gain in inet(case)
    ]
    report(
        Finding(
            "path loss from 8 m to 2 km: free space with an exponent of 3, breakpoint, two-ray ground "
            "reflection, two-ray interference with both polarizations and INET's sign, against INET",
            f"differs by at most {max(off):.1g} at {len(off)} points",
            "1e-9",
            "nothing is random; the phase of two-ray interference, of up to 16,000 wavelengths, is known to "
            "1e-11",
            max(off) <= 1e-9,
        )
    )


def test_antennas_are_inets(report: Callable[[Finding], None]) -> None:
    free_space = path_gain()
    off = [
        abs(free_space(place) * pattern(fields, *TURNED.get(case, ()))(place) / gain - 1)
        for case, fields in ANTENNAS.items()
        for place, gain in inet(case)
    ]
    report(
        Finding(
            "short dipoles, upright and lying, and parabolic antennas, straight and turned, in 24 "
            "directions, against INET",
            f"differs by at most {max(off):.1g} at {len(off)} points",
            "1e-12",
            "nothing is random: rounding",
            max(off) <= 1e-12,
        )
    )


def test_a_cosine_antenna_falls_twice_as_fast_as_inets(report: Callable[[Finding], None]) -> None:
    free_space, most = path_gain(), float(COSINE["max_gain"])
    off = []
    for place, gain in inet("Cosine"):
        theirs = gain / free_space(place) / most
        expected = theirs ** (2 * HALF_DB / 3)
        off.append(abs(pattern(COSINE)(place) / most / expected - 1))
    report(
        Finding(
            "a cosine antenna in 24 directions, against the square of INET's pattern",
            f"differs by at most {max(off):.1g} at {len(off)} points",
            "1e-9",
            "nothing is random; INET has 1.5 dB at half the beam width, here it is half the power, by "
            "decision; near the back rounding of the angle counts",
            max(off) <= 1e-9,
        )
    )


def test_boxes_cast_inets_shadow(report: Callable[[Finding], None]) -> None:
    from gradysim._netsim import ObstacleConfig

    obstacles = []
    for (left, front), (right, back), top_m in BOXES:
        obstacle = ObstacleConfig()
        obstacle.rings = [((left, front), (right, front), (right, back), (left, back))]
        obstacle.top_m = top_m
        obstacle.material = "concrete"
        obstacles.append(obstacle)
    gain = path_gain(obstacle_loss="IdealObstacleLoss", obstacles=obstacles)
    places = inet("Shadow")
    wrong = sum((gain(place) > 0) != (theirs > 0) for place, theirs in places)
    dark = sum(theirs == 0 for _, theirs in places)
    report(
        Finding(
            "the shadow of two boxes, one of them as low as the sender, at 24 places, against INET",
            f"{wrong} of {len(places)} places differ; {dark} in the shadow",
            "0",
            "nothing is random",
            wrong == 0,
        )
    )


@cache
def fading_gains(case: str) -> list[float]:
    """Return factors relative to free space, one for each frame."""
    from gradysim._netsim import MediumConfig, Propagation

    config = MediumConfig()
    free_space = Propagation(config, 1).gain(SENDER, RECEIVER, CARRIER_HZ)
    config.coherence_time_s = 0
    for field, value in FADING[case].items():
        setattr(config, field, value)
    propagation = Propagation(config, 1)
    gains = (
        propagation.gain(SENDER, RECEIVER, CARRIER_HZ, 0, 1, 1.0, frame) / free_space
        for frame in range(DRAWS)
    )
    return [sqrt(2 * gain) if case == "Rayleigh" else gain for gain in gains]


def test_fading_has_inets_distributions(report: Callable[[Finding], None]) -> None:
    p_values = {}
    for row in rows("inet_fading"):
        up_to = sum(10 * log10(gain) <= float(row["gain_db"]) for gain in fading_gains(row["case"]))
        p_values[f"{row['case']}, {row['gain_db']} dB"] = fisher_p(
            up_to, DRAWS, int(row["up_to_gain"]), int(row["frames"])
        )
    worst = min(p_values, key=lambda name: p_values[name])
    limit = least_p(len(p_values))
    report(
        Finding(
            "shadowing of 4 dB, Rician fading (K = 6 dB), Nakagami fading (m = 2.5), and Rayleigh fading as "
            "INET has it: shares of frames up to a gain, against INET",
            f"least p-value {p_values[worst]:.2g} of {len(p_values)} ({worst})",
            f"p ≥ {limit:.2g} for each",
            "sampling error at 99 % for all together (Fisher's exact test, Bonferroni; INET's 3000 frames "
            f"against {DRAWS:,} draws)",
            p_values[worst] >= limit,
        )
    )
