"""The runs of a study as a table, for scripts, pandas, polars and figures."""

import json
import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from gradysim.notebook import html_table
from gradysim.protocol.plain_value import as_float
from gradysim.results.files import read_run_file
from gradysim.results.means import Mean, means
from gradysim.results.omnetpp_reader import read_vectors
from gradysim.results.outcomes import Outcomes
from gradysim.results.quantity import Names, name_filter
from gradysim.results.quantity_table import OF_RUN, TAKEN, QuantityTable, column_of, union, variables_of
from gradysim.results.result_dir import read_results
from gradysim.results.run_summary import RunSummary
from gradysim.scenario.errors import ConfigError, unknown_name

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Per = Literal["run", "node", "time"]


def runs(directory: str | os.PathLike[str]) -> "Runs":
    """Return the runs in the directory of `gradysim run --result-dir` or in a pack, without interrupted ones.

    Raises ConfigError for a damaged file, and OSError.
    """
    return Runs(read_results(Path(directory)))


class Runs(QuantityTable):
    """Runs of a study: a sequence of `RunSummary`, with selection by `where` and tables by `columns`.

    A notebook shows the table of their means.
    """

    def __init__(self, summaries: Iterable[RunSummary], source: "Runs | None" = None) -> None:
        """Store runs in their order. Files of `source`, of which they are a part, may be temporary."""
        super().__init__(summaries)
        self._source = source

    def __repr__(self) -> str:
        configs = list(dict.fromkeys(run.config for run in self))
        return f"<{len(self)} runs of {', '.join(configs) or 'no configuration'}>"

    def _repr_html_(self) -> str:
        """Return the means of `means()` as a table, for notebooks."""
        found = self.means()
        variables = union(mean.iterations for mean in found)
        rows = [
            (
                mean.config,
                mean.mode,
                *(mean.iterations.get(name, "") for name in variables),
                mean.quantity,
                mean.runs,
                "" if mean.mean is None else f"{mean.mean:.6g}",
                "" if mean.low is None or mean.high is None else f"{mean.low:.4g} to {mean.high:.4g}",
            )
            for mean in found
        ]
        headings = ("config", "mode", *map(column_of, variables), "quantity", "runs", "mean", "95 % interval")
        about = f"{len(self)} runs: means with confidence intervals"
        return html_table(about, headings, rows, in_caption=("config", "mode", "runs"))

    @property
    def variables(self) -> list[str]:
        """Names of the variables: `OF_RUN`, then the iteration variables of any run."""
        return union([OF_RUN, *map(variables_of, (runs[0] for runs in self.blocks))])

    def values(self, variable: str) -> list[Any]:
        """Return the different values of a variable, in the order of the runs.

        Raises ConfigError for an unknown variable.
        """
        if variable not in self.variables:
            raise unknown_name(f"no variable of the runs is called `{variable}`", variable, self.variables)
        return list(dict.fromkeys(variables_of(run).get(variable) for run in self))

    def where(self, **wanted: object) -> "Runs":
        """Return the runs with these values of variables, `where(mode="integrated", jitter=["1ms", "10ms"])`.

        A number may also be given as a string. Raises ConfigError for a variable or value of no run.
        """
        kept = list(self)
        for variable, value in wanted.items():
            known = self.values(variable)
            several = list(value) if isinstance(value, list | tuple | set | range) else [value]
            for each in several:
                if not any(_is_same(each, other) for other in known):
                    raise unknown_name(f"no run has {variable} = {each}", str(each), map(str, known))
            kept = [
                run
                for run in kept
                if any(_is_same(each, variables_of(run).get(variable)) for each in several)
            ]
        return Runs(kept, self)

    def means(self, quantities: Names | None = None) -> list[Mean]:
        """Return means with 95 % confidence intervals, as `gradysim means` prints them.

        `quantities` selects by name, with `*` and `?`, as in `read_means`.
        """
        return means(self, quantities)

    def columns(self, *names: str, per: Per = "run") -> dict[str, list[Any]]:
        """Return a table as {name of the column: its values}, for `polars.DataFrame` and `pandas.DataFrame`.

        Each table begins with the columns of `variables`. `names` selects what follows, with `*` for any
        letters and `?` for any single one; by default it is everything:

        - `per="run"` has a row for each run and a column for each of `quantities`.
        - `per="node"` has a row for each node of each run: `node`, and a column for each tracked variable.
        - `per="time"` has a row for each number in a `.vec` file: `node`, `quantity` (a tracked variable or
          `positionX`), `time_s` and `value`. Runs without that file are left out.

        A cell is None where a run has no such value. A column has numbers only, or strings only.
        Raises ConfigError for a name that nothing has, and OSError.
        """
        rows: dict[Per, Callable[[Names | None], Iterator[tuple[RunSummary, Mapping[str, Any]]]]] = {
            "run": self._run_rows,
            "node": self._node_rows,
            "time": self._time_rows,
        }
        if per not in rows:
            raise ConfigError(f'per = "{per}": expected one of {", ".join(rows)}')
        table = [variables_of(run) | dict(row) for run, row in rows[per](names or None)]
        headings = dict.fromkeys([*self.variables, *(name for row in table for name in row)])
        return {name: _uniform([row.get(name) for row in table]) for name in headings}

    def frame(self, *names: str, per: Per = "run") -> Any:
        """Return the table of `columns` as a `pandas.DataFrame`. Raises ImportError if pandas is missing."""
        try:
            pandas = import_module("pandas")
        except ImportError as error:
            raise ImportError(
                "a frame needs pandas: pip install pandas (the extra `pandas` of gradysim)"
            ) from error
        return pandas.DataFrame(self.columns(*names, per=per))

    def plot(
        self, *, kind: str = "line", columns: int = 1, log: Iterable[str] = (), **arguments: Any
    ) -> "Figure":
        """Return a figure of the runs, which a notebook shows: `plot(x="jitter", y="station heard")`.

        Arguments and exceptions are those of `gradysim.plots.draw`.
        """
        from gradysim.plots import draw

        return draw(self, kind=kind, columns=columns, log=log, **arguments)

    def vectors(
        self, names: Names | None = None
    ) -> Iterator[tuple[RunSummary, str, str, Sequence[float], Sequence[float]]]:
        """Yield run, node, quantity, times in s and values for each vector in the `.vec` files of the runs.

        `names` selects quantities. Raises OSError and ValueError as `read_vectors`.
        """
        patterns = [names] if isinstance(names, str) else names
        for run in self:
            file = run.file.with_suffix(".vec")
            if file.is_file():
                for row in read_vectors(file, patterns and [f"{pattern}:vector" for pattern in patterns]):
                    node = row["module"].partition(".")[2].rpartition(".")[0]
                    yield run, node, row["name"].removesuffix(":vector"), row["vectime"], row["vecvalue"]

    def _run_rows(self, names: Names | None) -> Iterator[tuple[RunSummary, Mapping[str, Any]]]:
        known = self.quantities
        _check(names, known)
        chosen = list(filter(name_filter(names), known))
        for run in self:
            yield run, {name: run.number(name) for name in chosen}

    def _node_rows(self, names: Names | None) -> Iterator[tuple[RunSummary, Mapping[str, Any]]]:
        found = [(run, node) for run in self for node in nodes_of(run)]
        known = dict.fromkeys(name for _, node in found for name in node["tracked_variables"])
        _check(names, known)
        taken = {*TAKEN, *self.variables}
        chosen = {name: f"${name}" if name in taken else name for name in filter(name_filter(names), known)}
        for run, node in found:
            tracked = node["tracked_variables"]
            cells = {column: tracked.get(name) for name, column in chosen.items()}
            yield run, {"node": node["name"], **cells}

    def _time_rows(self, names: Names | None) -> Iterator[tuple[RunSummary, Mapping[str, Any]]]:
        for run, node, quantity, times_s, values in self.vectors(names):
            for time_s, value in zip(times_s, values, strict=True):
                yield run, {"node": node, "quantity": quantity, "time_s": time_s, "value": value}


def nodes_of(run: RunSummary) -> list[dict[str, Any]]:
    """Return the nodes in a run's file. Raises OSError, and ValueError if it is damaged."""
    nodes: list[dict[str, Any]] = read_run_file(run.file)["nodes"]
    return nodes


def outcomes_of(run: RunSummary) -> Outcomes:
    """Return the outcomes in a run's file. Raises OSError, and ValueError if it is damaged."""
    outcomes: Outcomes = read_run_file(run.file)["outcomes"]
    return outcomes


def _check(names: Names | None, known: Iterable[str]) -> None:
    for name in names or ():
        if not any(map(name_filter(name), known)):
            raise unknown_name(f"no quantity is called `{name}`", name, known)


def _is_same(wanted: object, value: object) -> bool:
    if wanted == value or str(wanted) == str(value):
        return True
    try:
        return isinstance(value, int | float) and float(str(wanted)) == value
    except ValueError:
        return False


def _uniform(cells: list[Any]) -> list[Any]:
    """Return a column of which all cells have one type, or are None."""
    numbers = [_INFINITIES.get(cell, cell) if isinstance(cell, str) else cell for cell in cells]
    types = {type(number) for number in numbers if number is not None}
    if types <= {int, float, bool}:
        return numbers if len(types) == 1 else [as_float(number) for number in numbers]
    return [cell if cell is None or isinstance(cell, str) else json.dumps(cell) for cell in cells]


_INFINITIES = {"inf": math.inf, "-inf": -math.inf}
"""As JSON objects have them."""
