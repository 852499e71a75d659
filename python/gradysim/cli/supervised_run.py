"""One run as the command line carries it out: nothing that was computed is lost, however the run ends."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from rich.console import Console

from gradysim.cli.progress import RunProgress
from gradysim.integrated.compiled_part import CompiledPartMissingError
from gradysim.results.result import RunResult
from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.lint import Finding
from gradysim.scenario.scenario import Scenario


class Run(Protocol):
    """A run of either mode, built and ready."""

    def execute(
        self,
        progress: Callable[[float], None] | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> None:
        """Run to the end; raise what a protocol raises."""

    def result(self) -> RunResult:
        """Return what has been computed up to now."""

    def findings(self) -> list[Finding]:
        """Return what lint checks found in the protocols up to now."""


@dataclass(frozen=True)
class Outcome:
    """How a run ended, and what it computed until then.

    Attributes:
        result: None if the run could not even be built.
        failure: What a protocol raised, in a callback or when it was made.
        interrupted: Whether Ctrl-C ended it.
        findings: What lint checks found in the protocols.
    """

    result: RunResult | None
    failure: BaseException | None = None
    interrupted: bool = False
    findings: Sequence[Finding] = ()


def carry_out(
    build: Callable[[Scenario], Run],
    scenario: Scenario,
    should_stop: Callable[[], bool],
    progress_console: Console | None = None,
) -> Outcome:
    """Build and execute the run of `scenario`, with a progress bar on `progress_console` if there is one.

    `should_stop()` says that Ctrl-C was pressed. What is wrong with the scenario or the installation
    (ConfigError, CompiledPartMissingError) is raised.
    """
    try:
        run = build(scenario)
    except (ConfigError, CompiledPartMissingError, KeyboardInterrupt):
        raise
    except BaseException as failure:
        return Outcome(None, failure=failure)
    try:
        if progress_console is None:
            run.execute(should_stop=should_stop)
        else:
            title = f"{scenario.config} run {scenario.run_number}"
            with RunProgress(progress_console, title, scenario.sim_time_limit_s) as bar:
                run.execute(bar.update, should_stop)
    except KeyboardInterrupt:
        return Outcome(run.result(), interrupted=True, findings=run.findings())
    except BaseException as failure:  # SystemExit and asyncio.CancelledError are no Exception
        return Outcome(run.result(), failure=failure, findings=run.findings())
    result = run.result()
    return Outcome(result, interrupted=result.interrupted, findings=run.findings())
