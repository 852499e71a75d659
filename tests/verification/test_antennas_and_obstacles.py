"""Antenna patterns, a wall and the shadow of a building against closed forms, written in plain Python."""

from cmath import exp, sqrt
from collections.abc import Callable
from math import acos, cos, hypot, log, log10, pi, radians, sin
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from verification.finding import Finding

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CARRIER_HZ = 2.412e9
SPEED_OF_LIGHT_MPS = 299_792_458.0
WAVELENGTH_M = SPEED_OF_LIGHT_MPS / CARRIER_HZ
STATION = (-60.0, 8.0, 3.0)
HALL = ((0.0, -20.0), (30.0, -20.0), (30.0, 5.0), (12.0, 25.0), (0.0, 25.0))
HALL_TOP_M = 12.0
INNER_WALLS = ((0.3, -19.7), (29.7, -19.7), (29.7, 4.9), (11.87, 24.7), (0.3, 24.7))
"""Inner walls of a hall with walls of 30 cm."""
ANTENNAS: tuple[tuple[str, dict[str, float | str]], ...] = (
    ("DipoleAntenna", {"wire_axis": "y"}),
    ("DipoleAntenna", {"wire_axis": "y", "length_m": WAVELENGTH_M / 2}),
    ("DipoleAntenna", {"wire_axis": "y", "length_m": WAVELENGTH_M}),
    ("CosineAntenna", {"max_gain": 10.0, "beam_width_rad": radians(60)}),
    ("ParabolicAntenna", {"max_gain": 10.0, "min_gain": 0.01, "beam_width_rad": radians(60)}),
)


def engine_pattern(typename: str, fields: dict[str, float | str]) -> Callable[[float], float]:
    """Return the gain over the angle from x towards y."""
    from gradysim._netsim import AntennaConfig, antenna_gain

    config = AntennaConfig()
    config.typename = typename
    for field, value in fields.items():
        setattr(config, field, value)
    return lambda angle: antenna_gain(config, CARRIER_HZ, (cos(angle), sin(angle), 0.0))


def closed_pattern(typename: str, fields: dict[str, float | str]) -> Callable[[float], float]:
    if typename == "DipoleAntenna":
        half_length = pi * float(fields.get("length_m", 0)) / WAVELENGTH_M

        def intensity(from_wire: float) -> float:
            if half_length == 0:
                return sin(from_wire) ** 2
            return ((cos(half_length * cos(from_wire)) - cos(half_length)) / sin(from_wire)) ** 2

        steps = 20_000
        angles = [(step + 0.5) * pi / steps for step in range(steps)]
        mean = sum(intensity(angle) * sin(angle) for angle in angles) * pi / steps / 2
        return lambda angle: intensity(acos(sin(angle))) / mean
    width = float(fields["beam_width_rad"])
    most = float(fields["max_gain"])
    if typename == "CosineAntenna":
        exponent = log(0.5) / log(cos(width / 4))
        return lambda angle: most * abs(cos(angle / 2)) ** exponent
    least = float(fields["min_gain"])
    return lambda angle: float(max(most * 10 ** (-1.2 * (angle / width) ** 2), least))


def test_patterns(report: Callable[[Finding], None]) -> None:
    worst, points = 0.0, 0
    for typename, fields in ANTENNAS:
        engine, closed = engine_pattern(typename, fields), closed_pattern(typename, fields)
        for step in range(-179, 180):
            angle = radians(step + 0.5)
            worst = max(worst, abs(engine(angle) - closed(angle)))
            points += 1
    report(
        Finding(
            "antenna patterns: three dipoles, cosine, parabolic, around a plane, against the closed forms",
            f"gain differs by at most {worst:.1g} at {points} points",
            "1e-7",
            "nothing is random; the closed form's directivity is a sum of 20,000 terms",
            worst <= 1e-7,
        )
    )


def medium_with(obstacle_loss: str, rings: object, top_m: float, material: str) -> Callable[..., float]:
    from gradysim._netsim import MediumConfig, ObstacleConfig, Propagation

    obstacle = ObstacleConfig()
    obstacle.rings = rings  # type: ignore[assignment]
    obstacle.top_m = top_m
    obstacle.material = material
    config = MediumConfig()
    config.obstacle_loss = obstacle_loss
    config.obstacles = [obstacle]
    propagation = Propagation(config, 1)
    return lambda a, b: propagation.gain(a, b, CARRIER_HZ)


def free_space(a: tuple[float, float, float], b: tuple[float, float, float]) -> float:
    return (WAVELENGTH_M / (4 * pi * hypot(*(p - q for p, q in zip(a, b, strict=True))))) ** 2


def through_wall(cosine: float, thickness_m: float, permittivity: complex) -> float:
    """Return the loss of both faces by Fresnel's formulas, and of the field's decay e^(-j k √ε d)."""
    root = sqrt(permittivity - (1 - cosine**2))
    across = abs((cosine - root) / (cosine + root)) ** 2
    along = abs((permittivity * cosine - root) / (permittivity * cosine + root)) ** 2
    face = 1 - (across + along) / 2
    decay = abs(exp(-2j * pi / WAVELENGTH_M * sqrt(permittivity) * thickness_m / cosine)) ** 2
    return face**2 * decay


def test_a_wall(report: Callable[[Finding], None]) -> None:
    vacuum_permittivity = 8.8541878128e-12
    ghz = CARRIER_HZ / 1e9
    worst, points = 0.0, 0
    for material, a, c, d in (
        ("brick", 3.91, 0.0238, 0.16),
        ("wood", 1.99, 0.0047, 1.0718),
        ("glass", 6.31, 0.0036, 1.3394),
        ("concrete", 5.24, 0.0462, 0.7822),
    ):
        permittivity = complex(a, -c * ghz**d / (2 * pi * CARRIER_HZ * vacuum_permittivity))
        for thickness_m in (0.01, 0.24):
            wall = ((0.0, -100.0), (thickness_m, -100.0), (thickness_m, 100.0), (0.0, 100.0))
            gain = medium_with("DielectricObstacleLoss", [wall], 100.0, material)
            for degrees in range(0, 86, 5):
                there = (50.0 * cos(radians(degrees)), 50.0 * sin(radians(degrees)), 3.0)
                here = (-there[0], -there[1], 3.0)
                expected = free_space(here, there) * through_wall(
                    cos(radians(degrees)), thickness_m, permittivity
                )
                worst = max(worst, abs(gain(here, there) / expected - 1))
                points += 1
    report(
        Finding(
            "a wall of four materials, 1 cm and 24 cm, 0° to 85°, against complex refraction and wave number",
            f"differs by at most {worst:.1g} at {points} points",
            "1e-9",
            "nothing is random: rounding",
            worst <= 1e-9,
        )
    )


def is_in_shadow(place: tuple[float, float, float]) -> bool:
    """Check many points of the line of sight, one by one."""
    steps = 4000
    for step in range(1, steps):
        x, y, z = (p + (q - p) * step / steps for p, q in zip(STATION, place, strict=True))
        if 0 < z < HALL_TOP_M and 0 < x < 30 and -20 < y < 25 and 10 * (x - 12) + 9 * (y - 25) < 0:
            return True
    return False


@pytest.mark.verify
def test_the_shadow_of_a_building(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("antennas_and_obstacles.png", draw)
    gain = medium_with("IdealObstacleLoss", [HALL], HALL_TOP_M, "concrete")
    wrong, dark, points = 0, 0, 0
    for height_m in (2.0, 20.0):
        for column in range(40):
            for row in range(20):
                place = (-73.3 + 5 * column, -48.7 + 5 * row, height_m)
                blocked = gain(STATION, place) == 0
                wrong += blocked != is_in_shadow(place)
                dark += blocked
                points += 1
    report(
        Finding(
            "the shadow of a building with five walls, at two heights, against lines of sight point by point",
            f"{wrong} of {points} places differ; {dark} in the shadow",
            "0",
            "nothing is random; no place is so near the border that points 5 cm apart could miss it",
            wrong == 0,
        )
    )


def draw(path: Path) -> None:
    from verification.figure import INET, MODEL, OURS, save

    degrees = [step / 2 for step in range(-360, 361)]

    def patterns(axes: "Axes") -> None:
        names = ("short dipole", "half-wave dipole", "full-wave dipole", "cosine, 60°", "parabolic, 60°")
        colors = (OURS, "#5fa8d3", "#9ad1d4", INET, MODEL)
        reach = 0.0
        for (typename, fields), name, color in zip(ANTENNAS, names, colors, strict=True):
            gain = engine_pattern(typename, fields)
            # Polar plot: the radius is the gain in decibels above -25 dB.
            radii = [max(10 * log10(max(gain(radians(angle)), 1e-9)) + 25, 0) for angle in degrees]
            reach = max(reach, *radii)
            axes.plot(
                [radius * cos(radians(angle)) for radius, angle in zip(radii, degrees, strict=True)],
                [radius * sin(radians(angle)) for radius, angle in zip(radii, degrees, strict=True)],
                color=color,
                lw=1.2,
                label=name,
            )
        for level in (-15, -5, 5):
            ring = [(level + 25) * cos(radians(angle)) for angle in degrees]
            axes.plot(
                ring, [(level + 25) * sin(radians(angle)) for angle in degrees], color="#cccccc", lw=0.6
            )
            axes.annotate(f"{level} dB", (0, level + 25), fontsize=6.5, color="#777777", ha="center")
        axes.set(aspect="equal", xticks=[], yticks=[], xlim=(-reach - 2, reach + 2))
        axes.set_title("gain by direction, boresight to the right, wires upright", fontsize=9)
        axes.legend(fontsize=6.5, loc="lower left")

    def shadow(obstacle_loss: str, rings: object, material: str, title: str) -> "Callable[[Axes], None]":
        gain = medium_with(obstacle_loss, rings, HALL_TOP_M, material)

        def panel(axes: "Axes") -> None:
            xs = [-75 + 0.75 * column for column in range(280)]
            ys = [-50 + 0.75 * row for row in range(134)]
            power = [[10 * log10(max(20 * gain(STATION, (x, y, 2.0)), 1e-30)) for x in xs] for y in ys]
            image = axes.pcolormesh(xs, ys, power, vmin=-110, vmax=-40, cmap="viridis", rasterized=True)
            axes.plot(*zip(*HALL, HALL[0], strict=True), color="white", lw=1)
            axes.plot(*STATION[:2], "^", color="white", ms=6)
            axes.set(aspect="equal", xlabel="x (m)", ylabel="y (m)")
            axes.set_title(title, fontsize=9)
            axes.figure.colorbar(image, ax=axes, label="received (dBm)", shrink=0.8)

        return panel

    save(
        path,
        "Antennas, and what is received 2 m above the ground from 20 mW at the triangle",
        patterns,
        shadow("IdealObstacleLoss", [HALL], "concrete", "IdealObstacleLoss"),
        shadow("DielectricObstacleLoss", [HALL, INNER_WALLS], "brick", "DielectricObstacleLoss, brick walls"),
        columns=3,
        width=5.0,
    )
