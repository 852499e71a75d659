"""Numbers of the figures of a ladder and of a curve of jitters, for `gradysim.plots.save_numbers`."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from gradysim.ladder.desync import Desync
from gradysim.ladder.ladder import Rung
from gradysim.plots.line import draw_line
from gradysim.plots.numbers import Curve, Numbers, caption_of, columns_of, label_of
from gradysim.results.confidence_interval import Estimate

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MOST_CATEGORIES = 5
"""Largest number of categories whose names fit next to each other."""


def ladder_numbers(rungs: Sequence[Rung], metric: str, run_count: int) -> Numbers:
    """Return the mean of the metric at each level, with its 95 % interval."""
    rungs = [rung for rung in rungs if rung.metric is not None]
    names = [rung.level.name for rung in rungs]
    curve = Curve(
        {},
        {
            "level": names,
            "runs": [run_count] * len(rungs),
            **columns_of([rung.metric for rung in rungs if rung.metric is not None]),
        },
    )
    return Numbers(_draw, [curve], "level", label_of(metric), caption_of("mean", [run_count]), names)


def _draw(axes: "Axes", numbers: Numbers) -> "Axes":
    if len(numbers.categories) > _MOST_CATEGORIES:
        axes.tick_params("x", rotation=30)
    return draw_line(axes, numbers)


def jitter_numbers(found: Desync) -> Numbers:
    """Return the delivery ratio for each jitter above 0."""
    without, trials = found.trials[0], found.trials[1:]
    curve = Curve(
        {},
        {
            "jitter (s)": [trial.jitter_s for trial in trials],
            "runs": [found.runs_per_trial] * len(trials),
            **columns_of([Estimate(trial.delivery) for trial in trials]),
        },
    )
    caption = f"{without.delivery:.3f} without jitter; n = {found.runs_per_trial} runs"
    return Numbers(draw_line, [curve], "jitter (s)", "receptions delivered", caption)
