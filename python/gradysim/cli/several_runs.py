"""Many runs, one after the other or several at once, and what is told if not all come to their end."""

import os
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, TextIO

from gradysim.cli.exit_code import FAILED, INTERRUPTED, OK, say_mistake
from gradysim.cli.fresh_protocols import with_fresh_protocols
from gradysim.cli.sudden_end import tell_of_crashes, told_of_exit

if TYPE_CHECKING:
    from gradysim.cli.interrupt import StopOnInterrupt
    from gradysim.scenario.scenario import Scenario

    CarryOut = Callable[[Scenario, StopOnInterrupt, TextIO], int]
    """Carries out a run, prints to the output it is given, and returns an exit code."""


def one_after_the_other(scenarios: "Sequence[Scenario]", carry_out: "CarryOut", output: TextIO) -> int:
    """Carry out runs up to the first that fails or is interrupted; return the exit code of the command."""
    from gradysim.cli.interrupt import StopOnInterrupt

    tell_of_crashes()
    with StopOnInterrupt() as interrupt:
        for done, scenario in enumerate(scenarios):
            codes = dict.fromkeys(range(done), OK)
            say_failed = partial(say_unfinished, scenarios, {**codes, done: FAILED})
            try:
                with told_of_exit(f"{scenario.config} run {scenario.run_number}", say_failed):
                    code = carry_out(with_fresh_protocols(scenario) if done else scenario, interrupt, output)
            except KeyboardInterrupt:  # while it was built, or before
                say_unfinished(scenarios, codes)
                return INTERRUPTED
            if code != OK:
                say_unfinished(scenarios, {**codes, done: code})
                return code
    return OK


def check_jobs(jobs: int) -> None:
    """Raise ConfigError for a number of runs at once that cannot be, before anything is read."""
    from gradysim.scenario.errors import ConfigError

    if jobs < 1:
        raise ConfigError(f"--jobs {jobs}: it is out of range; expected 1 or more")
    if jobs > 1 and not hasattr(os, "fork"):
        raise ConfigError(f"--jobs {jobs}: this system cannot divide a process into two; expected --jobs 1")


def several_at_once(scenarios: "Sequence[Scenario]", carry_out: "CarryOut", output: TextIO, jobs: int) -> int:
    """Carry out runs in `jobs` processes; return the exit code of the command."""
    from gradysim.cli.processes import in_processes
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.scenario.errors import ConfigError

    def work(index: int, interrupt: "StopOnInterrupt", output: TextIO) -> int:
        try:
            return carry_out(scenarios[index], interrupt, output)
        except KeyboardInterrupt:  # while it was built
            return INTERRUPTED
        except (ConfigError, CompiledPartMissingError, OSError) as mistake:
            return say_mistake(mistake)

    tell_of_crashes()
    names = [f"{scenario.config} run {scenario.run_number}" for scenario in scenarios]
    codes = in_processes(work, names, jobs, output)
    if len(codes) < len(scenarios) or any(codes.values()):
        say_unfinished(scenarios, codes)
        return next((code for code in codes.values() if code not in (OK, INTERRUPTED)), INTERRUPTED)
    return OK


def say_unfinished(scenarios: "Sequence[Scenario]", codes: Mapping[int, int]) -> None:
    """Say on the error output which of several runs are not there; `codes` are those of the runs begun."""
    from gradysim.cli.unfinished_runs import text_of_unfinished

    if len(scenarios) > 1:
        numbers = [scenario.run_number for scenario in scenarios]
        done = [number for index, number in enumerate(numbers) if codes.get(index) == OK]
        left = [number for index, number in enumerate(numbers) if index not in codes]
        ended = {
            numbers[index]: "was interrupted" if code == INTERRUPTED else "failed"
            for index, code in sorted(codes.items())
            if code != OK
        }
        print(text_of_unfinished(scenarios[0].config, done, ended, left), file=sys.stderr)
