"""`gradysim run --share`: one of several shares of a study, such as that of a task in a job array.

Shares are dealt round-robin: share I of N has the runs at positions I, I + N, I + 2N, … of the list of runs.
They need no communication, and a slow part of the parameter space is spread over all of them.
"""

import os
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass

from gradysim.scenario.errors import ConfigError

_GIVEN = re.compile(r"(?:auto|(\d{1,9}))(?:/(\d{1,9}))?", re.ASCII)


@dataclass(frozen=True)
class Share:
    """Share `index` of `count`, where `index` is 0 to `count` - 1."""

    index: int
    count: int

    @property
    def part(self) -> slice:
        """The positions of its runs in the list of runs."""
        return slice(self.index, None, self.count)

    def __str__(self) -> str:
        return f"{self.index}/{self.count}"


@dataclass(frozen=True)
class _Array:
    """Variables in the environment of a task of a job array.

    Attributes:
        index: Variable with the index of the task.
        first: Variables with the first and the last index, and the step between two of them; none if the
            scheduler does not say how many tasks there are.
        count: Variable with the number of tasks, if the indices need not be a range.
    """

    index: str
    bounds: tuple[str, str, str] | None = None
    count: str | None = None


_ARRAYS = (
    _Array(  # SLURM
        "SLURM_ARRAY_TASK_ID",
        ("SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_STEP"),
        "SLURM_ARRAY_TASK_COUNT",
    ),
    _Array("SGE_TASK_ID", ("SGE_TASK_FIRST", "SGE_TASK_LAST", "SGE_TASK_STEPSIZE")),  # Grid Engine
    _Array("PBS_ARRAY_INDEX"),  # PBS Professional and OpenPBS
    _Array("PBS_ARRAYID"),  # Torque
    _Array("JOB_COMPLETION_INDEX"),  # Kubernetes, an indexed job
)
"""The first one whose index is set is in force."""

_RANKS = (("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"), ("PMI_RANK", "PMI_SIZE"))
"""Rank of a process of mpirun, and their number: Open MPI; MPICH, Intel MPI and srun."""


def share_of(given: str, environment: Mapping[str, str]) -> tuple[Share, dict[str, str]]:
    """Return the share of this process, and the variables of the environment that were read.

    Args:
        given: `I/N`; or `auto`, for a share from the environment; or `auto/N`, for the index in the
            environment modulo N.
        environment: Variables of the environment.

    Raises:
        ConfigError: There is no such share, or the environment does not have what `auto` needs.
    """
    match = _GIVEN.fullmatch(given)
    if match is None or (match[1] and not match[2]):
        raise ConfigError(f"--share {given}: expected I/N, such as 0/4, or auto")
    count = int(match[2]) if match[2] else None
    if count == 0 or (match[1] and count is not None and int(match[1]) >= count):
        raise ConfigError(f"--share {given}: there is no such share; expected 0/N to N-1/N")
    if match[1] and count is not None:
        return Share(int(match[1]), count), {}
    return _Environment(given, environment).share(count)


class _Environment:
    """Reader of the environment. It keeps what it has read."""

    def __init__(self, given: str, variables: Mapping[str, str]) -> None:
        self._given = given
        self._variables = variables
        self._read: dict[str, str] = {}

    def share(self, count: int | None) -> tuple[Share, dict[str, str]]:
        """Return the share and the variables; of the processes of mpirun in an array, each has one."""
        array = next((each for each in _ARRAYS if self._has(each.index)), None)
        ranks = next((each for each in _RANKS if self._has(each[0])), None)
        if array is None and ranks is None:
            raise ConfigError(
                f"--share {self._given}: no variable of a job array or of MPI is set, such as"
                " SLURM_ARRAY_TASK_ID; expected I/N"
            )
        rank = Share(0, 1) if ranks is None else Share(self._number(ranks[0]), self._number(ranks[1]))
        if count is None:
            task = Share(0, 1) if array is None else self._task(array)
            return Share(task.index * rank.count + rank.index, task.count * rank.count), self._read
        first = 0 if array is None else self._number(array.index)
        return Share((first * rank.count + rank.index) % count, count), self._read

    def _task(self, array: _Array) -> Share:
        index = self._number(array.index)
        if array.bounds is None:
            raise ConfigError(
                f"--share {self._given}: {array.index} is {index}, but no variable has the number of tasks;"
                f" expected --share {self._given}/N"
            )
        first, last, step = map(self._number, array.bounds)
        count = (last - first) // max(step, 1) + 1
        if array.count is not None and self._number(array.count) != count:
            raise ConfigError(
                f"--share {self._given}: the {self._number(array.count)} tasks of the array are not a range;"
                f" expected --share {self._given}/N, with the N of the whole array"
            )
        return Share((index - first) // max(step, 1), count)

    def _has(self, name: str) -> bool:
        return self._variables.get(name, "undefined") != "undefined"  # what Grid Engine sets outside arrays

    def _number(self, name: str) -> int:
        text = self._variables.get(name, "")
        self._read[name] = text
        try:
            return int(text)
        except ValueError:
            raise ConfigError(f"--share {self._given}: {name} is `{text}`; expected an integer") from None


def part_of_share(given: str | None) -> slice:
    """Return the positions of the runs of --share; of all runs if it is None.

    Prints what `auto` stands for to standard error. Raises ConfigError.
    """
    if given is None:
        return slice(None)
    share, read = share_of(given, os.environ)
    if read:
        variables = ", ".join(f"{name}={text}" for name, text in read.items())
        print(f"--share {given}: share {share}, from {variables}", file=sys.stderr)
    return share.part
