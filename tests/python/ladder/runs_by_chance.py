"""A campaign without a simulator: runs fail by chance, with a given probability at each level."""

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from random import Random

from gradysim.ladder.bisect import Effects
from gradysim.ladder.jitter import Jitter
from gradysim.ladder.levels import Level
from gradysim.ladder.observation import Observation


class RunsByChance:
    """Runs whose quantity `works` is 1 or 0.

    With common random numbers, as in a real campaign, a seed that fails with some probability fails with all
    larger ones, too. With `independent` levels, each draws for itself.
    """

    def __init__(
        self, failing: Sequence[float], seed: int, *, independent: bool = False, most: int = 400
    ) -> None:
        self.levels = [Level(f"level{number}", "") for number in range(len(failing))]
        self._failing, self._seed, self._independent, self._most = failing, seed, independent, most
        self.submitted: list[tuple[Effects, int]] = []
        """(effects, position of the run) in the order of submission."""

    def __len__(self) -> int:
        return self._most

    def effects_up_to(self, level: int) -> Effects:
        return frozenset(each.name for each in self.levels[: level + 1])

    def working(self, effects: Effects) -> Effects:
        return effects

    def observations(
        self,
        executor: Executor | None,
        effects: Effects,
        indices: Sequence[int],
        quantities: Sequence[str],
        jitter: Jitter | None = None,
    ) -> Iterator[Observation]:
        level = max(number for number, each in enumerate(self.levels) if each.name in effects)
        self.submitted += [(effects, index) for index in indices]
        return (self._seen(level, index) for index in indices)

    def _seen(self, level: int, index: int) -> Observation:
        key = f"{self._seed} {index} {level if self._independent else ''}"
        return Observation({"works": float(Random(key).random() >= self._failing[level])})
