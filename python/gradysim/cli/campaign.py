"""What the commands about levels of realism share: the campaign, and the executor of its runs."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.cli.options import CampaignOptions

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from gradysim.ladder.campaign import Campaign
    from gradysim.plots.numbers import Numbers


def campaign_of(file: Path, options: CampaignOptions, run_count: int) -> "Campaign":
    """Return the campaign of a command line. Raises ConfigError."""
    from gradysim.ladder.campaign import Campaign
    from gradysim.scenario.errors import ArgumentNames

    return Campaign(
        file,
        options.config,
        settings=options.settings,
        run_count=run_count,
        seed=options.seed,
        names=ArgumentNames(overrides="--set", seed="--seed", runs="-n", config="-c"),
    )


@contextmanager
def executor_of(options: CampaignOptions) -> "Iterator[Executor]":
    """Yield an executor with a process for each run.

    No run has a result to keep, so the first Ctrl-C raises KeyboardInterrupt, and all processes are killed.
    """
    from gradysim.cli.interrupt import StopOnInterrupt
    from gradysim.cli.runner import ForkExecutor

    with ForkExecutor(options.jobs, StopOnInterrupt()) as executor:
        yield executor


def save(
    path: Path, numbers: "Numbers", file: Path, options: CampaignOptions, *, log: tuple[str, ...] = ()
) -> None:
    """Draw a figure, and say on standard error where it is. Raises what `save_numbers` raises."""
    from gradysim.plots import save_numbers

    origin = {"file": str(file), "config": options.config, "settings": options.settings, "seed": options.seed}
    figure, table, provenance = save_numbers(path, numbers, origin, log=log)
    print(f"drawn in {figure}; numbers in {table}, origin in {provenance}", file=sys.stderr)
