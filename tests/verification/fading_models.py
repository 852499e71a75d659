"""Distributions of fading and the correlation in time, in closed form, independent of the engine.

Gains are relative to the power in free space.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import cos, erf, exp, lgamma, log, log10, pi, sin, sqrt

Distribution = Callable[[float], float]


@dataclass(frozen=True)
class Model:
    """One model of fading with its parameters."""

    path_loss: str
    label: str
    fields: tuple[tuple[str, float], ...]
    distribution: Distribution
    """Cumulative distribution function of the gain."""


def shadowing(sigma_db: float) -> Distribution:
    """Normal distribution of decibels."""
    return lambda gain: (1 + erf(10 * log10(gain) / sigma_db / sqrt(2))) / 2


def rayleigh(gain: float) -> float:
    """Exponential distribution of powers."""
    return 1 - exp(-gain)


def rician(k: float) -> Distribution:
    """Sum of gamma distributions over a Poisson distributed number of additional degrees of freedom.

    2 (K + 1) times the gain is chi-square distributed with 2 degrees of freedom and noncentrality 2 K.
    Source: N. L. Johnson, S. Kotz, N. Balakrishnan, "Continuous Univariate Distributions" 2, 1995, 29.3.
    """
    count = int(k + 12 * sqrt(k) + 30)
    weights = [exp(n * log(k) - k - lgamma(n + 1)) for n in range(count)]

    def share(gain: float) -> float:
        x = (k + 1) * gain
        term, below_n, total = exp(-x), 0.0, 0.0  # term: of the Poisson distribution with mean x
        for n, weight in enumerate(weights):
            below_n += term  # 1 - P(n + 1, x)
            term *= x / (n + 1)
            total += weight * (1 - below_n)
        return total

    return share


def gamma(shape: float) -> Distribution:
    """Nakagami's m: gamma distributed powers with mean 1, by Simpson's rule on the density over √x.

    x = t² removes the pole of the density at 0, which exists for m < 1.
    """
    steps, top = 20_000, sqrt(80 / shape + 10)
    width = top / steps

    @cache
    def table() -> list[float]:
        factor = 2 * exp(shape * log(shape) - lgamma(shape))

        def density(t: float) -> float:
            if t == 0:
                return factor if shape == 0.5 else 0.0
            return factor * exp((2 * shape - 1) * log(t) - shape * t * t)

        sums = [0.0]
        for i in range(steps):
            a = i * width
            sums.append(sums[-1] + width / 6 * (density(a) + 4 * density(a + width / 2) + density(a + width)))
        return sums

    def share(gain: float) -> float:
        place = min(sqrt(gain) / width, steps - 1e-9)
        sums, index = table(), int(place)
        return sums[index] + (place - index) * (sums[index + 1] - sums[index])

    return share


def correlation(lag: float) -> float:
    """Correlation of the normal numbers behind fading at `lag` coherence times, averaged over the phase.

    Independent numbers at the borders of intervals, weighted with cosine and sine in between.
    """
    if lag >= 2:
        return 0.0
    if lag <= 1:
        return (1 - lag / 2) * cos(pi * lag / 2) + sin(pi * lag / 2) / pi
    return (lag / 2 - 1) * sin(pi * (lag - 1) / 2) + cos(pi * (lag - 1) / 2) / pi


MODELS = (
    Model("LogNormalShadowing", "shadowing of 4 dB", (("sigma_db", 4.0),), shadowing(4.0)),
    Model("RayleighFading", "Rayleigh", (), rayleigh),
    Model("RicianFading", "Rician, K = 8 dB", (("k_db", 8.0),), rician(10**0.8)),
    Model("RicianFading", "Rician, K = 0 dB", (("k_db", 0.0),), rician(1.0)),
    Model("NakagamiFading", "Nakagami, m = 0.5", (("shape_factor", 0.5),), gamma(0.5)),
    Model("NakagamiFading", "Nakagami, m = 1", (("shape_factor", 1.0),), rayleigh),
    Model("NakagamiFading", "Nakagami, m = 3.3", (("shape_factor", 3.3),), gamma(3.3)),
)
"""Compared models."""
