"""`gradysim run --until`: repetitions until the confidence interval of a quantity is narrow enough."""

import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import inf

from gradysim.cli.options import RunOptions
from gradysim.results.confidence_interval import Estimate, estimate
from gradysim.results.files import read_run_file, run_file
from gradysim.results.run_summary import RunSummary
from gradysim.scenario.errors import ConfigError, unknown_name
from gradysim.scenario.load import Study
from gradysim.scenario.resolve.sweep import text_of_iterations

BATCH = 5
"""Number of repetitions after which it is decided whether they are enough."""

_CONDITION = re.compile(r"\s*ci\((?P<quantity>.+)\)\s*<\s*(?P<percent>\d+(\.\d+)?)\s*%\s*", re.ASCII)


@dataclass(frozen=True)
class Until:
    """Condition that half the width of the 95 % interval is below `percent` of the mean.

    Attributes:
        text: As the user wrote it.
        quantity: As in `gradysim means`.
    """

    text: str
    quantity: str
    percent: float


def checked_until(options: RunOptions) -> Until | None:
    """Return the condition of `--until`, if there is one. Raises ConfigError."""
    if options.until is None:
        return None
    match = _CONDITION.fullmatch(options.until)
    if match is None or not float(match["percent"]):
        raise ConfigError(f"--until {options.until}: expected `ci(QUANTITY) < 5%`")
    if options.result_dir is None:
        raise ConfigError(
            "--until: it goes by the JSON files of --result-dir, which is not given;"
            " expected --result-dir DIR, too"
        )
    return Until(options.until.strip(), match["quantity"].strip(), float(match["percent"]))


def rounds_of(
    study: Study, left: Sequence[int], until: Until | None, options: RunOptions
) -> Iterator[Sequence[int]]:
    """Yield the positions in `study` of the runs to do next, those in `left`. One round without a condition.

    A round has the next `BATCH` repetitions of each combination of values that does not meet the condition
    yet. So the runs that are done depend on their results only. The caller does each round before it asks for
    the next one. After the last round, prints what was reached. Raises ConfigError for an unknown quantity
    and for a single repetition, and OSError.
    """
    if until is None:
        yield left
        return
    wanted, numbers = set(left), _Numbers(study, until, options)
    unmet = study.indices_of_repetitions()
    if max(map(len, unmet)) < 2:
        raise ConfigError(
            f"--until {until.text}: a single repetition has no interval",
            expected="`repeat` of 2 or more, the largest number of repetitions",
        )
    done = 0
    while wide := [indices for indices in unmet if done < len(indices)]:
        batch = [(number, indices[number]) for indices in wide for number in _next(done, indices)]
        yield [index for _, index in sorted(batch) if index in wanted]
        done += BATCH
        numbers.read(index for indices in wide for index in indices[:done])
        unmet = [indices for indices in unmet if numbers.percent_of(indices[:done]) >= until.percent]
    _tell(study, until, options, numbers, unmet)


def _next(done: int, indices: Sequence[int]) -> range:
    return range(done, min(done + BATCH, len(indices)))


class _Numbers:
    """The quantity of a condition in the results of runs. Each result is read once."""

    def __init__(self, study: Study, until: Until, options: RunOptions) -> None:
        self._study = study
        self._until = until
        self._options = options
        self._numbers: dict[int, float | None] = {}
        self._binary = True  # as long as it is 0 or 1 in all runs

    @property
    def run_count(self) -> int:
        """Number of results that were read."""
        return len(self._numbers)

    def read(self, indices: Iterable[int]) -> None:
        """Read the results of these runs, unless they are known. Raises ConfigError and OSError."""
        for index in indices:
            if index not in self._numbers:
                summary = self._summary(index)
                self._binary = self._binary and summary.is_binary(self._until.quantity)
                self._numbers[index] = summary.number(self._until.quantity)

    def percent_of(self, indices: Sequence[int]) -> float:
        """Return the width of the interval of runs that were read, as `percent_of_mean` does."""
        numbers = [number for index in indices if (number := self._numbers[index]) is not None]
        return percent_of_mean(estimate(numbers, binary=self._binary)) if numbers else inf

    def _summary(self, index: int) -> RunSummary:
        study, options = self._study, self._options
        file = run_file(options.directory, study.config, study.numbers[index], options.mode)
        summary = RunSummary.of(read_run_file(file), file)
        if not self._numbers and self._until.quantity not in summary.numbers:
            quantity = self._until.quantity
            problem = f"--until {self._until.text}: no quantity is called `{quantity}`"
            raise unknown_name(problem, quantity, summary.numbers)
        return summary


def percent_of_mean(found: Estimate) -> float:
    """Return half the width of an interval in percent of the mean; infinite for a single number.

    For a mean of 0, the upper end is in percent of 1: the probability of an event that no run had.
    """
    if found.low is None or found.high is None or found.half_width is None:
        return inf
    if found.mean == 0:
        return 100 * found.high if found.low == 0 else inf
    return 100 * found.half_width / abs(found.mean)


def _tell(
    study: Study, until: Until, options: RunOptions, numbers: _Numbers, unmet: Sequence[Sequence[int]]
) -> None:
    """Print how many runs meet the condition, or to standard error by how much they do not."""
    if unmet:
        wide = []
        for indices in unmet:
            values = text_of_iterations(study[indices[0]].iterations)
            percent = f"{numbers.percent_of(indices):.3g}%"
            wide.append(f"{percent} with {values}" if values else percent)
        print(
            f"{study.config}: warning: the repetitions do not reach {until.text}: {', '.join(wide)};"
            " expected a larger `repeat`",
            file=sys.stderr,
        )
    elif not (options.as_json or options.quiet):
        print(f"{study.config}: {numbers.run_count} of {len(study)} runs reach {until.text}")
