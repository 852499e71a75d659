"""Which runs of a configuration are meant, and how they are written: "0,2,5..9"."""

import re
from collections.abc import Iterable, Sequence
from operator import index

from gradysim.scenario.errors import OF_SCRIPT, ConfigError, Source

_RANGE = re.compile(r"\s*(\d{1,9})\s*(?:(?:\.\.|-)\s*(\d{1,9})\s*)?", re.ASCII)


def select_runs(
    runs: str | Iterable[int] | None,
    count: int,
    config: str,
    source: Source,
    made_of: str = "",
    name: str = OF_SCRIPT.runs,
) -> list[int]:
    """The run numbers, in increasing order, each once; all of 0 to count-1 for None.

    `source` is where `count` comes from, and `made_of` says how, if it is not `repeat` alone. `name` is what
    messages about `runs` begin with.

    Raises:
        ConfigError: The text is no list of numbers, or there is no such run.
        TypeError: `runs` is neither a text nor whole numbers.
    """
    if runs is None:
        return list(range(count))
    ranges = _ranges(runs, name) if isinstance(runs, str) else _single_runs(runs, name)
    for numbers in ranges:
        if not numbers or numbers.start < 0 or numbers.stop > count:
            run = numbers.start if not numbers or numbers.start < 0 else numbers.stop - 1
            has = "run 0" if count == 1 else f"runs 0 to {count - 1}"
            raise ConfigError(
                f"configuration `{config}` has no run {run}; expected {has}"
                f" ({made_of or f'`repeat = {count}`'})",
                source,
            )
    return sorted({run for numbers in ranges for run in numbers})


def text_of_runs(numbers: Sequence[int]) -> str:
    """Write run numbers that increase so that `select_runs` reads them."""
    parts: list[list[int]] = []
    for number in numbers:
        if parts and parts[-1][-1] == number - 1:
            parts[-1].append(number)
        else:
            parts.append([number])
    return ",".join(f"{part[0]}..{part[-1]}" if part[1:] else str(part[0]) for part in parts)


def _single_runs(runs: Iterable[int], name: str) -> list[range]:
    try:
        return [range(run, run + 1) for run in map(index, runs)]
    except TypeError:
        raise TypeError(f"{name} {runs!r:.80}: expected numbers of runs, such as [0, 2]") from None


def _ranges(text: str, name: str) -> list[range]:
    ranges = []
    for part in text.split(","):
        match = _RANGE.fullmatch(part)
        if match is None or (match[2] and int(match[2]) < int(match[1])):
            raise ConfigError(f"{name} {text}: expected numbers of runs and ranges such as `0,2,5..9`")
        ranges.append(range(int(match[1]), int(match[2] or match[1]) + 1))
    return ranges
