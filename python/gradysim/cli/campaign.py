"""What the commands about levels of realism share: campaign, executor and output."""

import json
import sys
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

from gradysim.cli.fork_executor import ForkExecutor
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.options import CampaignOptions
from gradysim.cli.study import drawn_text
from gradysim.ladder.campaign import Campaign
from gradysim.ladder.kept_runs import KeptRuns
from gradysim.plots import save_numbers
from gradysim.plots.numbers import Numbers
from gradysim.protocol.plain_value import plain_value
from gradysim.scenario.errors import ArgumentNames, ConfigError


@contextmanager
def campaign_of(file: Path, options: CampaignOptions, run_count: int) -> Iterator[tuple[Campaign, Executor]]:
    """Yield the campaign of a command line, and an executor with a process for each run.

    The first Ctrl-C, SIGTERM or SIGHUP kills all processes, and says what became of the runs that have ended.

    Raises:
        ConfigError: Anything is wrong with the file or the options.
        OSError: The runs cannot be kept.
        SystemExit: After a signal, with the exit code of the command.
    """
    if options.resume and options.result_dir is None:
        raise ConfigError("--resume: expected --result-dir DIR, too, where the runs are kept")
    keeping = (
        nullcontext()
        if options.result_dir is None
        else KeptRuns(options.result_dir, options.config, resume=options.resume)
    )
    with keeping as kept, StopOnInterrupt() as interrupt:
        campaign = None
        try:
            with interrupt.at_once():
                campaign = Campaign(
                    file,
                    options.config,
                    settings=options.settings,
                    run_count=run_count,
                    seed=options.seed,
                    names=ArgumentNames(overrides="--set", seed="--seed", runs="-n", config="-c"),
                    kept=kept,
                )
                with ForkExecutor(options.jobs, interrupt) as executor:
                    yield campaign, executor
        except KeyboardInterrupt:
            count = 0 if campaign is None else campaign.run_count
            ended = f"stopped; {count} {'run has' if count == 1 else 'runs have'} ended"
            where = (
                f"and kept in {kept.path}: --resume finds them"
                if kept
                else "and lost: --result-dir DIR keeps them"
            )
            print(f"\n{ended} {where}", file=sys.stderr)
            raise SystemExit(interrupt.exit_code) from None


def print_json(plain: dict[str, Any]) -> None:
    """Print a JSON object on one line."""
    print(json.dumps(plain_value(plain)))


def save(
    path: Path, numbers: Numbers, file: Path, options: CampaignOptions, *, log: tuple[str, ...] = ()
) -> None:
    """Draw a figure, and say on standard error where it is. Raises what `save_numbers` raises."""
    origin = {"file": str(file), "config": options.config, "settings": options.settings, "seed": options.seed}
    print(drawn_text(save_numbers(path, numbers, origin, log=log)), file=sys.stderr)
