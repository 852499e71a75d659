"""The two-ray models against their closed forms, written in plain Python with complex amplitudes."""

from cmath import exp, sqrt
from collections.abc import Callable
from math import hypot, log10, pi
from pathlib import Path
from typing import TYPE_CHECKING

from verification.finding import Finding

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CARRIER_HZ = 2.412e9
WAVELENGTH_M = 299_792_458 / CARRIER_HZ
HEIGHTS_M = ((1.5, 1.5), (2.0, 30.0), (50.0, 120.0))
GROUNDS = ((1.02, "horizontal"), (15.0, "horizontal"), (15.0, "vertical"))
DISTANCES_M = tuple(10 ** (step / 100) for step in range(401))
"""Distances on the ground: 1 m to 10 km."""


def free_space_amplitude(length_m: float) -> float:
    return WAVELENGTH_M / (4 * pi * length_m)


def interference(ground_m: float, low_m: float, high_m: float, epsilon_r: float, polarization: str) -> float:
    """Return the squared sum of two rays with their phases; path lengths affect the phases only."""
    direct_m, reflected_m = hypot(ground_m, high_m - low_m), hypot(ground_m, high_m + low_m)
    sine, cosine = (high_m + low_m) / reflected_m, ground_m / reflected_m
    bent = sqrt(epsilon_r - cosine**2).real
    straight = sine if polarization == "horizontal" else epsilon_r * sine
    coefficient = (straight - bent) / (straight + bent)
    amplitude = free_space_amplitude(direct_m) * sum(
        strength * exp(-2j * pi * length_m / WAVELENGTH_M)
        for strength, length_m in ((1.0, direct_m), (coefficient, reflected_m))
    )
    return float(min(abs(amplitude) ** 2, 1.0))


def ground_reflection(ground_m: float, low_m: float, high_m: float) -> float:
    distance_m = hypot(ground_m, high_m - low_m)
    crossover_m = 4 * pi * low_m * high_m / WAVELENGTH_M
    if distance_m < crossover_m:
        return float(min(free_space_amplitude(distance_m) ** 2, 1.0))
    return float(min((low_m * high_m / distance_m**2) ** 2, 1.0))


def engine(
    path_loss: str, epsilon_r: float = 1.02, polarization: str = "horizontal"
) -> "Callable[[float, float, float], float]":
    from gradysim._netsim import MediumConfig, Propagation

    config = MediumConfig()
    config.path_loss = path_loss
    config.epsilon_r = epsilon_r
    config.polarization = polarization
    propagation = Propagation(config, 1)
    return lambda ground_m, low_m, high_m: propagation.gain(
        (0.0, 0.0, low_m), (ground_m, 0.0, high_m), CARRIER_HZ
    )


def test_two_ray_interference(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("two_ray.png", draw)
    worst, points = 0.0, 0
    for epsilon_r, polarization in GROUNDS:
        gain = engine("TwoRayInterference", epsilon_r, polarization)
        for low_m, high_m in HEIGHTS_M:
            for ground_m in DISTANCES_M:
                # Relative to the strength of one ray: where both cancel, almost nothing is left to compare.
                scale = free_space_amplitude(hypot(ground_m, high_m - low_m)) ** 2
                expected = interference(ground_m, low_m, high_m, epsilon_r, polarization)
                worst = max(worst, abs(gain(ground_m, low_m, high_m) - expected) / scale)
                points += 1
    report(
        Finding(
            "two-ray interference, 1 m to 10 km, three heights, three grounds, against the closed form",
            f"differs by at most {worst:.1g} of the power of one ray at {points} points",
            "1e-8",
            "nothing is random; the closed form knows a phase of 80,000 wavelengths only to 1e-10",
            worst <= 1e-8,
        )
    )


def test_two_ray_ground_reflection(report: Callable[[Finding], None]) -> None:
    gain = engine("TwoRayGroundReflection")
    worst, points = 0.0, 0
    for low_m, high_m in HEIGHTS_M:
        for ground_m in DISTANCES_M:
            expected = ground_reflection(ground_m, low_m, high_m)
            worst = max(worst, abs(gain(ground_m, low_m, high_m) / expected - 1))
            points += 1
    report(
        Finding(
            "two-ray ground reflection, 1 m to 10 km, three heights, against the closed form",
            f"differs by at most {worst:.1g} at {points} points",
            "1e-12",
            "nothing is random: rounding",
            worst <= 1e-12,
        )
    )


def draw(path: Path) -> None:
    from verification.figure import INET, MODEL, OURS, save

    def panel_of(low_m: float, high_m: float) -> "Callable[[Axes], None]":
        def panel(axes: "Axes") -> None:
            for label, color, width, gain in (
                ("two-ray interference, ε = 1.02", OURS, 1.2, engine("TwoRayInterference")),
                ("two-ray ground reflection", INET, 1.0, engine("TwoRayGroundReflection")),
                ("free space", MODEL, 0.8, engine("FreeSpacePathLoss")),
            ):
                axes.plot(
                    DISTANCES_M,
                    [10 * log10(max(gain(ground_m, low_m, high_m), 1e-20)) for ground_m in DISTANCES_M],
                    color=color,
                    lw=width,
                    label=label,
                )
            axes.set(xscale="log", xlabel="distance on the ground (m)", ylabel="gain (dB)", ylim=(-150, -30))
            axes.set_title(f"heights {low_m:g} m and {high_m:g} m", fontsize=9)
            axes.legend(fontsize=7.5, loc="lower left")

        return panel

    save(path, "Path loss with a ground, 2.412 GHz", *(panel_of(*heights) for heights in HEIGHTS_M))
