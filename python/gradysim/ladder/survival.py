"""A check for tests: a protocol works at all levels of realism."""

from collections.abc import Iterable
from concurrent.futures import Executor
from pathlib import Path

from gradysim.ladder.assertion import Assertion
from gradysim.ladder.bisect import Bisection
from gradysim.ladder.campaign import Campaign
from gradysim.ladder.words import verdict_sentences


def assert_survives(
    file: str | Path,
    config: str = "General",
    *,
    assertion: str,
    settings: Iterable[str] = (),
    confidence: float = 0.95,
    max_runs: int = 400,
    executor: Executor | None = None,
) -> None:
    """Check that a protocol works at all levels of realism that its scenario has, in all of the runs.

    All of the budget is used if it does. With the default, a failure in 2 % of the seeds at the last level is
    found with a probability of 95 %.

    Args:
        file: The .ini file.
        config: Name of the configuration in it.
        assertion: What the protocol has to achieve, such as `groundStation collected >= 100`.
        settings: "KEY=VALUE" strings that precede the file.
        confidence: 1 less the error rate of the level that the message names, see `Bisection`; > 0.5 and < 1.
        max_runs: Budget of runs; at least one for each level.
        executor: Executes the runs, see `Campaign.observations`; None for this process.

    Raises:
        AssertionError: A run fails at some level. The message says at which one.
        ConfigError: Anything is wrong with the file, the settings or the assertion.
    """
    campaign = Campaign(file, config, settings=settings, run_count=max_runs)
    bisection = Bisection(
        campaign, Assertion.parse(assertion), executor, confidence=confidence, max_runs=max_runs
    )
    verdict = bisection.find()
    if verdict.fails is not None:
        raise AssertionError("\n".join(verdict_sentences(bisection, verdict)))
