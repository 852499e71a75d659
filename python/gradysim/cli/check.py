"""`gradysim check`: all errors and lint findings of a file, without a run."""

import contextlib
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.errors import MISTAKE, OK, report_error
from gradysim.cli.options import FileArgument, Mode, SetOption
from gradysim.cli.runs import check, findings_of
from gradysim.integrated.compiled_part import CompiledPartMissingError
from gradysim.scenario.errors import ConfigError, ConfigErrors, ErrorCollector
from gradysim.scenario.lint import Finding
from gradysim.scenario.parse.ini import read_ini
from gradysim.scenario.parse.sections import config_names

ConfigsOption = Annotated[
    str | None,
    Parameter(
        name="--config",
        alias="-c",
        show_default=False,
        help="Name of the configuration. All configurations of the file by default.",
    ),
]


def check_file(
    file: FileArgument,
    /,
    *,
    config: ConfigsOption = None,
    mode: Annotated[Mode, Parameter(help="The mode to check for, as of `gradysim run`.")] = "integrated",
    settings: SetOption = (),
) -> int:
    """Carry out `gradysim check`, and return the exit code."""
    errors = ErrorCollector()
    findings: list[Finding] = []
    configs = [config] if config is not None else []
    try:
        # Protocols may print. After many errors, reading stops by ConfigErrors.
        with contextlib.suppress(ConfigErrors), errors.collecting(), contextlib.redirect_stdout(sys.stderr):
            configs = configs or config_names(read_ini(file))
            for name in configs:
                findings += check_config(file, name, mode, settings, errors)
    except (CompiledPartMissingError, OSError) as error:
        return report_error(error)
    found = ConfigErrors(errors.errors).errors if errors.errors else []
    reports: list[ConfigError | Finding] = [*found, *dict.fromkeys(findings)]
    for report in sorted(reports, key=lambda each: (str(each.file or ""), each.line)):
        print(report)
    counts = f"{_counted(len(found), 'error')} and {_counted(len(reports) - len(found), 'warning')}"
    print(f"{counts} in {_counted(len(configs), 'configuration')}")
    return MISTAKE if found else OK


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def check_config(
    file: Path, config: str, mode: Mode, settings: Sequence[str], errors: ErrorCollector
) -> list[Finding]:
    """Check one configuration. Returns the lint findings; `errors` takes the errors."""
    if mode == "prototype":
        from gradysim.prototype.simulation import check_scenario
    else:
        from gradysim.integrated.network import check_scenario

    before = len(errors.errors)
    findings: list[Finding] = []
    with errors.collecting():
        scenarios = check(file, config, None, settings).checked_in_full()
        for scenario in scenarios:
            with errors.collecting():
                check_scenario(scenario)
        if len(errors.errors) == before:
            findings = findings_of(scenarios, mode)
    return findings
