"""Two sets of runs compared by pairs of the same seed: quantities, and losses of frames by cause."""

from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass

from gradysim.results.confidence_interval import Estimate, estimate
from gradysim.results.outcomes import loss_shares
from gradysim.results.paired import compare_pairs
from gradysim.results.quantity import Names
from gradysim.results.quantity_table import QuantityTable, grouped, union, values_of, variables_of
from gradysim.results.run_summary import RunSummary
from gradysim.results.run_table import Runs, outcomes_of
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
        higher: Number of pairs in which the second number is larger.
    """

    values: Mapping[str, object]
    quantity: str
    pairs: int
    first: Estimate | None
    second: Estimate | None
    difference: Estimate | None
    higher: int = 0


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

    @classmethod
    def of(
        cls, first: Iterable[RunSummary], second: Iterable[RunSummary], variables: Sequence[str]
    ) -> "Pairs":
        """Return the pairs with equal values of these variables.

        Raises ConfigError if a run has several partners.
        """
        of_first, of_second = (_by_key(runs, variables) for runs in (first, second))
        pairs = [(run, of_second[key]) for key, run in of_first.items() if key in of_second]
        return cls(variables, pairs, (len(of_first) - len(pairs), len(of_second) - len(pairs)))

    def changes(self, quantities: Names | None = None) -> list[Change]:
        """Return the change of each quantity, for each combination of values.

        `quantities` selects as in `read_means`. By default they are those that `gradysim means` prints.
        """
        table = QuantityTable(self.all_runs)
        shown = table.shown(quantities)
        return self.changes_of(shown, {name for name in shown if table.is_binary(name)})

    def losses(self) -> list[Change]:
        """Return the change of each cause of loss, as a share of receptions, if any was lost.

        A mode that does not have a cause loses nothing by it.
        """
        shares = {id(run): loss_shares(outcomes_of(run)) for run in self.all_runs}
        causes = union(
            [(kind, cause) for kind, of_kind in of_kinds.items() for cause, share in of_kind.items() if share]
            for of_kinds in shares.values()
        )

        def numbers(run: RunSummary) -> dict[str, float]:
            kinds = shares[id(run)]
            return {f"{kind} {cause}": kinds[kind].get(cause, 0.0) for kind, cause in causes if kind in kinds}

        found = self.changes_of(map(" ".join, causes), numbers_of=numbers)
        return [loss for loss in found if any(side and side.mean for side in (loss.first, loss.second))]

    @property
    def all_runs(self) -> list[RunSummary]:
        """The runs of all pairs: of the first set, then of the second one."""
        return [run for side in zip(*self.runs, strict=True) for run in side]

    def changes_of(
        self,
        quantities: Iterable[str],
        binary: Container[str] = (),
        numbers_of: Callable[[RunSummary], Mapping[str, float]] = lambda run: run.numbers,
    ) -> list[Change]:
        """Return the change of each of these quantities that a run has, for each combination of values."""
        names = list(quantities)
        found = []
        for values, pairs in grouped(self.runs, lambda pair: values_of(pair[0], self.variables)).items():
            numbers = [(numbers_of(first), numbers_of(second)) for first, second in pairs]
            for name in names:
                known = [(first.get(name), second.get(name)) for first, second in numbers]
                if any(number is not None for pair in known for number in pair):
                    of_values = dict(zip(self.variables, values, strict=True))
                    found.append(_change(of_values, name, known, binary=name in binary))
        return found


def _change(
    values: Mapping[str, object],
    name: str,
    numbers: Sequence[tuple[float | None, float | None]],
    *,
    binary: bool,
) -> Change:
    both = [(first, second) for first, second in numbers if first is not None and second is not None]
    if both:
        compared = compare_pairs(*zip(*both, strict=True), binary=binary)
        higher = sum(second > first for first, second in both)
        return Change(
            values, name, compared.pairs, compared.first, compared.second, compared.difference, higher
        )
    sides = [[number for number in side if number is not None] for side in zip(*numbers, strict=True)]
    first, second = (estimate(side, binary=binary) if side else None for side in sides)
    return Change(values, name, 0, first, second, None)


def varying_values(changes: Sequence[Change]) -> list[str]:
    """Return the variables of which the changes have several values."""
    names = union(change.values for change in changes)
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
    pairs = Pairs.of(first, second, variables)
    if not pairs.runs:
        raise ConfigError(
            f"no two runs to compare have the same {' and '.join(['seed', *variables])}",
            expected="`seed-set = ${repetition}` in the study",
        )
    return pairs


def _by_key(runs: Iterable[RunSummary], variables: Sequence[str]) -> dict[tuple[object, ...], RunSummary]:
    """Return the runs by seed and values. Raises ConfigError for two with the same ones."""
    found = grouped(runs, lambda run: (run.seed, *values_of(run, variables)))
    for one, *others in found.values():
        if others:
            known, values = variables_of(one), variables_of(others[0])
            names = [name for name in union((known, values)) if name not in _OWN]
            name = next((name for name in names if known.get(name) != values.get(name)), "")
            raise ConfigError(
                f"{one.name} and {others[0].name} have the same seed, {one.seed}"
                + (f", and differ in `{name}`" if name else ""),
                expected=f"one value: --where {name}={known.get(name)}" if name else "a seed for each run",
            )
    return {key: run for key, (run,) in found.items()}
