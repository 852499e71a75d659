"""Configuration of a simulation in prototype mode."""

from dataclasses import dataclass
from pathlib import Path

from gradysim.protocol.checked_values import checked_number
from gradysim.simulator.real_time import real_time_factor


@dataclass
class SimulationConfiguration:
    """End, speed and log of a simulation.

    Attributes:
        duration: Simulated seconds, >= 0. No later event runs. None: until no event is left.
        max_iterations: Largest number of events, >= 0. None: no limit.
        real_time: True: as fast as the wall clock. A number > 0: that many times as fast. False or 0: full
            speed.
        debug: Log from DEBUG on.
        log_file: Append the log to this file, too.
        execution_logging: False: log only warnings and errors.
        profile: Log at the end how often each kind of event happened and how long it took.
        timing_report: In real time, write the delay of each event to timing_report.csv in the current
            directory, and log a summary.
        seed: Seed of all random numbers of the run, >= 0. None: drawn from Python's global stream.
    """

    duration: float | None = None
    max_iterations: int | None = None
    real_time: bool | float = False
    debug: bool = False
    log_file: Path | None = None
    execution_logging: bool = True
    profile: bool = False
    timing_report: bool = False
    seed: int | None = None

    def validate(self) -> None:
        """Check all values. ValueError names the invalid one."""
        if self.duration is not None:
            checked_number("duration", self.duration, 0, infinite=True, unit="s")
        if self.max_iterations is not None and not _is_natural(self.max_iterations):
            raise ValueError(f"max_iterations must be an integer >= 0 or None, got {self.max_iterations!r}")
        real_time_factor(self.real_time)
        if self.seed is not None and not _is_natural(self.seed):
            raise ValueError(f"seed must be an integer >= 0 or None, got {self.seed!r}")
        if self.log_file is not None and not isinstance(self.log_file, str | Path):
            raise ValueError(f"log_file must be a Path or None, got {self.log_file!r}")


def _is_natural(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0
