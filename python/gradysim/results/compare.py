"""Two sets of runs compared by pairs of the same seed: quantities, and losses of frames by cause."""

from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass

from gradysim.results.confidence_interval import Estimate, estimate
from gradysim.results.means import means
from gradysim.results.outcomes import loss_shares
from gradysim.results.paired import compare_pairs
from gradysim.results.quantity import Names
from gradysim.results.run_summary import RunSummary
from gradysim.results.run_table import Runs, fates_of, variables_of
from gradysim.scenario.errors import ConfigError

_OWN = ("run", "seed")
"""Variables that are not values of a setting."""


@dataclass(frozen=True)
class Change:
    """One quantity in two sets of runs.

    Attributes:
        values: Values of variables that both runs of each pair have, such as `{"mode": "integrated"}`.
        quantity: As in `gradysim means`; for a loss, the kind of frame and the cause.
        pairs: Number of pairs of which both runs have a number.
        first: Mean in the first set; None if it has no number.
        second: Mean in the second set; None if it has no number.
        difference: Mean of second - first within each pair; None without pairs.
    """

    values: Mapping[str, object]
    quantity: str
    pairs: int
    first: Estimate | None
    second: Estimate | None
    difference: Estimate | None


@dataclass(frozen=True)
class Pairs:
    """Pairs of runs, one of each set, with the same seed.

    Attributes:
        variables: Variables of which both runs of a pair have the same value.
        runs: The pairs, in the order of the first set.
        left_out: Number of runs of the first and of the second set that have no partner.
    """

    variables: Sequence[str]
    runs: Sequence[tuple[RunSummary, RunSummary]]
    left_out: tuple[int, int]

    def changes(self, quantities: Names | None = None) -> list[Change]:
        """Return the change of each quantity, for each combination of values.

        `quantities` selects as in `read_means`. By default they are those that `gradysim means` prints.
        """
        wanted = dict.fromkeys(mean.quantity for mean in means(self.all_runs, quantities))
        runs = self.all_runs
        binary = {name for name in wanted if all(run.is_binary(name) for run in runs)}
        return self._compared(wanted, lambda run: run.numbers, binary)

    def losses(self) -> list[Change]:
        """Return the change of each cause of loss, as a share of receptions, if any was lost.

        A mode that does not have a cause loses nothing by it.
        """
        shares = {id(run): loss_shares(fates_of(run)) for run in self.all_runs}
        causes = dict.fromkeys(
            (kind, cause)
            for of_kinds in shares.values()
            for kind, of_kind in of_kinds.items()
            for cause, share in of_kind.items()
            if share
        )

        def numbers(run: RunSummary) -> dict[str, float]:
            of_kinds = shares[id(run)]
            return {
                f"{kind} {cause}": of_kinds[kind].get(cause, 0.0)
                for kind, cause in causes
                if kind in of_kinds
            }

        found = self._compared([" ".join(names) for names in causes], numbers)
        return [loss for loss in found if any(side and side.mean for side in (loss.first, loss.second))]

    @property
    def all_runs(self) -> list[RunSummary]:
        """The runs of all pairs: of the first set, then of the second one."""
        return [run for side in zip(*self.runs, strict=True) for run in side]

    def _compared(
        self,
        quantities: Iterable[str],
        numbers_of: Callable[[RunSummary], Mapping[str, float]],
        binary: Container[str] = (),
    ) -> list[Change]:
        alike: dict[tuple[object, ...], list[tuple[RunSummary, RunSummary]]] = {}
        for pair in self.runs:
            alike.setdefault(_values(pair[0], self.variables), []).append(pair)
        found = []
        for values, pairs in alike.items():
            numbers = [(numbers_of(first), numbers_of(second)) for first, second in pairs]
            for name in quantities:
                of_values = dict(zip(self.variables, values, strict=True))
                change = _change(of_values, name, numbers, binary=name in binary)
                if change.first or change.second:
                    found.append(change)
        return found


def _change(
    values: Mapping[str, object],
    name: str,
    numbers: Sequence[tuple[Mapping[str, float], Mapping[str, float]]],
    *,
    binary: bool,
) -> Change:
    both = [(first[name], second[name]) for first, second in numbers if name in first and name in second]
    if both:
        compared = compare_pairs(*zip(*both, strict=True), binary=binary)
        return Change(values, name, compared.pairs, compared.first, compared.second, compared.difference)
    sides = [[of_run[name] for of_run in side if name in of_run] for side in zip(*numbers, strict=True)]
    first, second = (estimate(side, binary=binary) if side else None for side in sides)
    return Change(values, name, 0, first, second, None)


def varying_values(changes: Sequence[Change]) -> list[str]:
    """Return the variables of which the changes have several values."""
    names = dict.fromkeys(name for change in changes for name in change.values)
    return [name for name in names if len({change.values.get(name) for change in changes}) > 1]


def pair_runs(first: Runs, second: Runs) -> Pairs:
    """Return the pairs of runs with the same seed and the same values of variables.

    A variable of which the sets have no value in common, such as the mode, is what they are compared for.
    Raises ConfigError if a run has several partners, or if no two runs are a pair.
    """
    variables = [
        name
        for name in first.variables
        if name not in _OWN and name in second.variables
        if not set(first.values(name)).isdisjoint(second.values(name))
    ]
    of_first, of_second = (_by_key(runs, variables) for runs in (first, second))
    pairs = [(run, of_second[key]) for key, run in of_first.items() if key in of_second]
    if not pairs:
        raise ConfigError(
            f"no two runs to compare have the same {' and '.join(['seed', *variables])}",
            expected="`seed-set = ${repetition}` in the study",
        )
    return Pairs(variables, pairs, (len(of_first) - len(pairs), len(of_second) - len(pairs)))


def _values(run: RunSummary, variables: Iterable[str]) -> tuple[object, ...]:
    values = variables_of(run)
    return tuple(values.get(name) for name in variables)


def _by_key(runs: Runs, variables: Sequence[str]) -> dict[tuple[object, ...], RunSummary]:
    """Return the runs by seed and values. Raises ConfigError for two with the same ones."""
    found: dict[tuple[object, ...], RunSummary] = {}
    for run in runs:
        other = found.setdefault((run.seed, *_values(run, variables)), run)
        if other is not run:
            known, values = variables_of(other), variables_of(run)
            differing = [name for name in runs.variables if known.get(name) != values.get(name)]
            name = next((name for name in differing if name not in _OWN), "")
            raise ConfigError(
                f"{other.name} and {run.name} have the same seed, {run.seed}"
                + (f", and differ in `{name}`" if name else ""),
                expected=f"one value: --where {name}={known.get(name)}" if name else "a seed for each run",
            )
    return found
