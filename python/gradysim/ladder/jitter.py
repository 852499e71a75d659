"""A random delay of timers, added to a run without a change of its protocols."""

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from gradysim.execution.scenario_run import ScenarioRun
from gradysim.ladder.callbacks import without_numbers
from gradysim.results.tracked_variables import group_of
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.scenario import Scenario


@dataclass(frozen=True)
class Jitter:
    """A delay that is drawn for each of some timers, from 0 to `longest_s`.

    Attributes:
        timers: (group of nodes, name of the timer, with "#" for numbers).
        longest_s: Largest delay in seconds.
    """

    timers: frozenset[tuple[str, str]]
    longest_s: float

    def add_to(self, run: ScenarioRun, scenario: Scenario) -> None:
        """Delay the timers of a run, before its start. Protocols of the engine have no such timers.

        The delays are drawn from random streams of their own, so that all other draws stay the same.
        """
        for spec in scenario.nodes:
            if names := self.timers_of(spec):
                provider = run.node(spec.name).provider
                stream = Random(f"{scenario.seed} {spec.id}")
                provider.schedule_timer = self._delayed(provider.schedule_timer, names, stream)

    def timers_of(self, spec: NodeSpec) -> set[str]:
        """Return the names of the delayed timers of a node, without numbers."""
        return {timer for group, timer in self.timers if group == group_of(spec.name)}

    def _delayed(
        self, schedule: Callable[[str, float], None], names: set[str], stream: Random
    ) -> Callable[[str, float], None]:
        def schedule_later(timer: str, timestamp: float) -> None:
            delay_s = stream.uniform(0, self.longest_s) if without_numbers(timer) in names else 0.0
            schedule(timer, timestamp + delay_s)

        return schedule_later
