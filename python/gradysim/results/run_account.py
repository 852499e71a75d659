"""The account of a run in either mode: what it costs, whether it came to its end, and its result."""

import contextlib
from collections.abc import Iterator, Mapping
from time import perf_counter, process_time

from gradysim.results.delays import Delays
from gradysim.results.run_result import Fates, Mode, NodeResult, RunResult
from gradysim.scenario.scenario import Scenario, require_scenario


class RunAccount:
    """Kept from before a run is built until it has been executed.

    Attributes:
        complete: Whether it came to its time limit; for who executes it to say.
    """

    def __init__(self, scenario: Scenario) -> None:
        """Count what the run of `scenario` costs from now on. Raises TypeError if it is no scenario."""
        require_scenario(scenario)
        self.complete = False
        self._scenario = scenario
        self._started_s = (perf_counter(), process_time())
        self._cost_s = (0.0, 0.0)

    @contextlib.contextmanager
    def of_execution(self) -> Iterator[None]:
        """Inside, the run is executed; afterwards its cost is known. A failure leaves it incomplete."""
        try:
            yield
        except BaseException:
            self.complete = False
            raise
        finally:
            self._cost_s = (perf_counter() - self._started_s[0], process_time() - self._started_s[1])

    def result(
        self,
        *,
        mode: Mode,
        sim_time_s: float,
        events: int,
        fingerprint: str | None,
        fates: Fates,
        message_delays: Mapping[str, Delays],
        nodes: tuple[NodeResult, ...],
    ) -> RunResult:
        """Return what has been computed up to now, with what the scenario says of the run."""
        scenario = self._scenario
        return RunResult(
            config=scenario.config,
            run=scenario.run_number,
            repetition=scenario.repetition,
            iterations=scenario.iterations,
            settings_hash=scenario.settings_hash,
            file_hashes=scenario.file_hashes,
            seed=scenario.seed,
            mode=mode,
            sim_time_s=sim_time_s,
            wall_s=self._cost_s[0],
            cpu_s=self._cost_s[1],
            events=events,
            interrupted=not self.complete,
            fingerprint=fingerprint,
            fates=fates,
            message_delays=message_delays,
            nodes=nodes,
        )
