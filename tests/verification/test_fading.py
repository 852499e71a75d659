"""Fading and shadowing: distributions over links and over time, and correlation in time.

Gains come from the engine's own propagation; closed forms from fading_models.py.
"""

from collections.abc import Callable
from functools import cache
from math import log10, sqrt
from pathlib import Path
from statistics import fmean
from typing import TYPE_CHECKING

import pytest

from verification.fading_models import MODELS, Model, correlation
from verification.finding import Finding
from verification.kolmogorov import ks_distance, ks_p
from verification.sampling import least_p

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DRAWS = 20_000
COHERENCE_TIME_S = 0.01
CARRIER_HZ = 2.412e9
HERE, THERE = (0.0, 0.0, 10.0), (200.0, 0.0, 10.0)
LAGS = tuple(step / 8 for step in range(21))
"""In coherence times."""


def gain_of(
    path_loss: str, fields: tuple[tuple[str, float], ...], seed: int = 1
) -> Callable[[int, float, int], float]:
    """Return the factor of fading relative to free space, by (other node, time, transmission)."""
    from gradysim._netsim import MediumConfig, Propagation

    config = MediumConfig()
    free_space = Propagation(config, seed).gain(HERE, THERE, CARRIER_HZ)
    config.path_loss = path_loss
    config.coherence_time_s = COHERENCE_TIME_S
    for field, value in fields:
        setattr(config, field, value)
    propagation = Propagation(config, seed)
    return lambda node, time, transmission: (
        propagation.gain(HERE, THERE, CARRIER_HZ, 0, node, time, transmission) / free_space
    )


@cache
def samples(model: Model) -> dict[str, list[float]]:
    """Return samples over links at one time between two borders of intervals, over time, and over frames."""
    gain = gain_of(model.path_loss, model.fields)
    fresh = gain_of(model.path_loss, (*model.fields, ("coherence_time_s", 0.0)))
    return {
        "links": [gain(node, 0.3 * COHERENCE_TIME_S, 0) for node in range(1, DRAWS + 1)],
        # Independent from two coherence times on; slightly more, so that all phases occur.
        "time": [gain(1, 2.137 * COHERENCE_TIME_S * step, 0) for step in range(DRAWS)],
        "frames": [fresh(1, 1.0, frame) for frame in range(DRAWS)],
    }


def test_distributions_are_those_of_the_models(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    picture("fading_distributions.png", draw_distributions)
    p_values = {
        f"{model.label} over {over}": ks_p(ks_distance(sample, model.distribution), len(sample))
        for model in MODELS
        for over, sample in samples(model).items()
    }
    limit = least_p(len(p_values))
    worst = min(p_values, key=lambda name: p_values[name])
    report(
        Finding(
            f"fading, shadowing: {len(MODELS)} cases over links, time and frames, against the distributions",
            f"least p-value {p_values[worst]:.2g} of {len(p_values)} ({worst})",
            f"p ≥ {limit:.2g} for each",
            f"sampling error at 99 % for all together (Kolmogorov-Smirnov test of {DRAWS:,} draws each, "
            "Bonferroni): false alarms at most 1 %",
            p_values[worst] >= limit,
        )
    )


@cache
def measured_correlation() -> list[float]:
    """Return the correlation of shadowing in decibels, the normal numbers, over links of different phases."""
    gain = gain_of("LogNormalShadowing", (("sigma_db", 1.0),))

    def decibels(lag: float) -> list[float]:
        return [
            10 * log10(gain(link, COHERENCE_TIME_S * (link / DRAWS + lag), 0)) for link in range(1, DRAWS + 1)
        ]

    here = decibels(0.0)
    return [fmean(a * b for a, b in zip(here, decibels(lag), strict=True)) for lag in LAGS]


def test_correlation_in_time(
    report: Callable[[Finding], None], picture: Callable[[str, Callable[[Path], None]], None]
) -> None:
    measured = measured_correlation()
    picture("fading_correlation.png", draw_correlation)
    worst = max(abs(value - correlation(lag)) for lag, value in zip(LAGS, measured, strict=True))
    tolerance = 4 * sqrt(2 / DRAWS)
    report(
        Finding(
            "fading: correlation over 0 to 2.5 coherence times, against the closed form",
            f"differs by at most {worst:.4f} at {len(LAGS)} lags; "
            f"{measured[LAGS.index(1.0)]:.3f} against {correlation(1.0):.3f} at one coherence time",
            f"{tolerance:.2f} at every lag",
            f"4 standard errors of a product of normal numbers, at most √(2 / {DRAWS:,}): "
            "false alarms below 0.2 %",
            worst <= tolerance,
        )
    )


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.label)
def test_both_directions_fade_alike(model: Model) -> None:
    from gradysim._netsim import MediumConfig, Propagation

    config = MediumConfig()
    config.path_loss = model.path_loss
    for field, value in model.fields:
        setattr(config, field, value)
    propagation = Propagation(config, 1)
    for step in range(200):
        forth = propagation.gain(HERE, THERE, CARRIER_HZ, 5, 6, step * 0.0031)
        assert propagation.gain(THERE, HERE, CARRIER_HZ, 6, 5, step * 0.0031) == forth


def draw_distributions(path: Path) -> None:
    from verification.figure import MODEL, OURS, save

    def draw(model: Model) -> "Callable[[Axes], None]":
        def panel(axes: "Axes") -> None:
            ordered = sorted(samples(model)["time"])
            shown = [ordered[round(share * (DRAWS - 1))] for share in (i / 60 for i in range(61))][1:-1]
            shares = [i / 60 for i in range(1, 60)]
            curve_db = [-30 + 0.1 * step for step in range(421)]
            axes.plot(
                curve_db,
                [model.distribution(10 ** (gain_db / 10)) for gain_db in curve_db],
                color=MODEL,
                lw=1,
                label="closed form",
            )
            axes.plot([10 * log10(gain) for gain in shown], shares, ".", color=OURS, ms=4, label="gradysim")
            axes.set(xlim=(-25, 12), xlabel="gain beside free space (dB)", ylabel="share of gains below")
            axes.set_title(model.label, fontsize=9)
            axes.legend(fontsize=7.5, loc="upper left")

        return panel

    save(
        path,
        f"Fading on one link over time, {DRAWS:,} draws each: gradysim and the models' distributions",
        *(draw(model) for model in MODELS if model.label != "Nakagami, m = 1"),  # equal to Rayleigh
        height=2.8,
    )


def draw_correlation(path: Path) -> None:
    from verification.figure import MODEL, OURS, save

    def correlations(axes: "Axes") -> None:
        fine = [step / 100 for step in range(251)]
        axes.plot(fine, [correlation(lag) for lag in fine], color=MODEL, lw=1, label="closed form")
        axes.plot(LAGS, measured_correlation(), ".", color=OURS, label="gradysim")
        axes.set(xlabel="lag (coherence times)", ylabel="correlation of the normal numbers")
        axes.legend(fontsize=7.5)

    def course(axes: "Axes") -> None:
        times = [step / 50 for step in range(501)]
        for path_loss, label, color in (
            ("RayleighFading", "Rayleigh", OURS),
            ("RicianFading", "Rician, K = 8 dB", MODEL),
        ):
            gain = gain_of(path_loss, ())
            axes.plot(
                times,
                [10 * log10(gain(1, time * COHERENCE_TIME_S, 0)) for time in times],
                color=color,
                lw=1,
                label=label,
            )
        axes.set(xlabel="time (coherence times)", ylabel="gain beside free space (dB)", ylim=(-30, 10))
        axes.legend(fontsize=7.5)

    save(
        path,
        "Fading in time: correlation over 20,000 links, and the course of one link",
        correlations,
        course,
    )
