"""gradysim: one protocol, run on ever more realistic networks of flying nodes.

`run` executes the runs of an `.ini` file, `load` reads them, `start` advances one step by step, and `runs`
reads the results of a study. For example::

    import gradysim as gs

    result = gs.run("hello.ini")
    study = gs.run("hello.ini", "Study", jobs=4, result_dir="results")
    study.plot(x="jitter", y="station heard")
"""

# What these functions import is slow to import, so they import it themselves.

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, overload

from gradysim import installation

if TYPE_CHECKING:
    import os

    from gradysim.execution.scenario_run import ScenarioRun
    from gradysim.results import Runs
    from gradysim.results.result import Mode, RunResult
    from gradysim.scenario import Scenario
    from gradysim.scenario.load import Study

__all__ = ["__version__", "load", "run", "runs", "start"]

installation.check(__path__)

__version__: str
"""Version of the installed package, with its commit if it is not a release.

An editable installation adds `editable`, since its sources may have changed after that commit.
"""


def load(
    file: "str | os.PathLike[str]",
    config: str = "General",
    runs: "str | int | Iterable[int] | None" = None,
    overrides: Iterable[str] = (),
    seed: int | None = None,
) -> "Study":
    """Read the runs of a configuration and check all of them, without executing any.

    Args:
        file: The .ini file.
        config: Name of the configuration in it.
        runs: Numbers of the wanted runs, or a string such as "0,2,5..9"; None for all.
        overrides: "KEY=VALUE" strings that precede the whole file, as with `gradysim run --set`.
        seed: Seed of run 0; run N adds N. None for the seed-set of the file.

    Returns:
        A sequence with a `Scenario` for each run.

    Raises:
        ConfigError: Anything is wrong. Several errors are a ConfigErrors, whose `errors` are sorted by line.
        TypeError: An argument has the wrong type.
    """
    from pathlib import Path

    from gradysim.scenario.errors import OF_SCRIPT
    from gradysim.scenario.load import Study

    wanted = [runs] if isinstance(runs, int) else runs
    return Study(Path(file), config, wanted, overrides, seed, OF_SCRIPT)


@overload
def run(
    source: "Scenario", *, mode: "Mode" = ..., replay: str | Iterable[str] = ..., progress: bool = ...
) -> "RunResult": ...


@overload
def run(
    source: "str | os.PathLike[str]",
    config: str = ...,
    *,
    runs: str | int | Iterable[int] | None = ...,
    overrides: Iterable[str] = ...,
    seed: int | None = ...,
    mode: "Mode" = ...,
    jobs: int = ...,
    result_dir: "str | os.PathLike[str] | None" = ...,
    resume: bool = ...,
    replay: str | Iterable[str] = ...,
    progress: bool = ...,
) -> "RunResult | Runs": ...


def run(
    source: "Scenario | str | os.PathLike[str]",
    config: str = "General",
    *,
    runs: str | int | Iterable[int] | None = None,
    overrides: Iterable[str] = (),
    seed: int | None = None,
    mode: "Mode" = "integrated",
    jobs: int = 1,
    result_dir: "str | os.PathLike[str] | None" = None,
    resume: bool = False,
    replay: str | Iterable[str] = (),
    progress: bool = True,
) -> "RunResult | Runs":
    """Run a scenario, or the runs of a configuration of a file.

    A single run is executed in this process and gives a `RunResult`. Several runs, and any with a
    `result_dir`, give a table of results, `Runs`. Each of them has a process of its own, as with
    `gradysim run`. A notebook or a terminal shows a progress bar.

    Args:
        source: The .ini file, or one scenario of `load`.
        config: Name of the configuration. This and what follows up to `seed` are the arguments of `load`.
        runs: Numbers of the wanted runs; None for all.
        overrides: "KEY=VALUE" strings that precede the whole file.
        seed: Seed of run 0.
        mode: "integrated" or "prototype".
        jobs: Number of runs at the same time, at least 1.
        result_dir: Directory for the files of results, which `gradysim.runs` reads again. None for a
            temporary one, which exists as long as the returned table.
        resume: Skip the runs that have a result with the same settings, seed and files in `result_dir`.
        replay: Nodes, groups or "all", which the replay of each run shows: see `view` of results.
        progress: Whether to show a bar.

    Raises:
        ConfigError: The file or an argument is not valid.
        StudyError: One of several runs failed. A single run raises what its protocol raises.
        ValueError, TypeError, OSError: As in `start`, and for files of results.
        KeyboardInterrupt: Ctrl-C, or an interrupted notebook. Complete results stay in `result_dir`.
    """
    from pathlib import Path

    from gradysim.scenario.scenario import Scenario
    from gradysim.scripting.run import run_file, run_scenario

    recorded = (replay,) if isinstance(replay, str) else tuple(replay)
    if isinstance(source, Scenario):
        return run_scenario(source, mode, recorded, progress=progress)
    return run_file(
        load(source, config, runs, overrides, seed),
        Path(source),
        mode=mode,
        jobs=jobs,
        result_dir=None if result_dir is None else Path(result_dir),
        resume=resume,
        replay=recorded,
        progress=progress,
    )


def runs(directory: "str | os.PathLike[str]") -> "Runs":
    """Return the table of the complete runs in a directory of results, or in a pack.

    Args:
        directory: The `result_dir` of `run` or of `gradysim run --result-dir`, or a file of `gradysim pack`.

    Raises:
        ConfigError: A file is damaged.
        OSError: A file or the directory cannot be read.
    """
    from gradysim.results.run_table import runs

    return runs(directory)


def start(scenario: "Scenario", mode: "Mode" = "integrated", **options: Any) -> "ScenarioRun":
    """Build a run of a scenario, to be advanced step by step.

    For example::

        with gradysim.start(scenario) as run:
            run.run_until(10.0)
            print(run.node("uavs[2]").position)
            run.run_until()
        result = run.result()

    Args:
        scenario: One of those that `load` returns.
        mode: "integrated" or "prototype".
        options: Arguments of `gradysim.integrated.run.IntegratedRun` or
            `gradysim.prototype.run.PrototypeRun`, such as `handlers` and `replay`.

    Raises:
        ValueError: There is no such mode.
        ConfigError: The mode does not accept a value of the scenario. See the two classes for others.
    """
    from gradysim.stepping import start

    return start(scenario, mode, **options)


def __dir__() -> list[str]:
    """Return the public names, and the modules that are loaded."""
    return sorted(
        {*__all__, *(name for name, value in globals().items() if type(value) is type(installation))}
    )


def __getattr__(name: str) -> Any:
    """Look up the version on first use, since this is slow."""
    if name == "__version__":
        from importlib.metadata import distribution

        installed = distribution("gradysim")
        if '"editable": true' not in (installed.read_text("direct_url.json") or ""):
            return installed.version
        return installed.version + (".editable" if "+" in installed.version else "+editable")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
