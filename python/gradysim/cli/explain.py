"""`gradysim explain`: which line sets a parameter, and which lines that hides."""

import contextlib
import sys
from collections.abc import Iterator
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.docs import with_commands
from gradysim.cli.errors import OK, report_error
from gradysim.cli.options import ConfigOption, FileArgument, Integer, SetOption
from gradysim.cli.runs import check
from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.explain import Explanation, explain
from gradysim.scenario.schema.keys import KEYS_BY_TARGET

_PARAMETER = "Path of a parameter, such as `uavs[3].mobility.speed`, or an option."
_WIDTH = 10


def explain_parameter(
    file: FileArgument,
    parameter: Annotated[str, Parameter(name="PARAMETER", help=_PARAMETER)],
    /,
    *,
    config: ConfigOption = "General",
    run: Annotated[Integer, Parameter(name=("--run", "-r", "--runs"), help="Number of the run.")] = 0,
    settings: SetOption = (),
) -> int:
    """Explain the value of a parameter: the line that sets it, the lines it hides, and what reads it."""
    try:
        with contextlib.redirect_stdout(sys.stderr):  # protocols may print
            (scenario,) = check(file, config, str(run), settings)
        explanation = explain(scenario, parameter)
    except (ConfigError, OSError) as error:
        return report_error(error)
    print(f"{explanation.name} = {explanation.value}")
    for label, text in _details(explanation):
        print(f"  {label:<{_WIDTH}}{text}")
    return OK


def _details(explanation: Explanation) -> Iterator[tuple[str, str]]:
    """Yield what else is known, each with a label."""
    yield "meaning", with_commands(explanation.meaning)
    for number, source in enumerate(explanation.sources):
        yield "hides" if number else "set by", _line(source)
    if explanation.instead is not None:
        yield "no effect", f"{_line(explanation.instead)} comes first"
    yield "default", explanation.default
    if explanation.lacking is not None:
        chooser = KEYS_BY_TARGET[explanation.lacking.chosen_by].written
        names = " or ".join(f'"{name}"' for name in explanation.lacking.names)
        yield "read by", f'nothing: that takes `{chooser} = {names}`, and it is "{explanation.chosen}"'
    elif explanation.read_by:
        yield "read by", ", ".join(explanation.read_by)


def _line(source: Source) -> str:
    return str(source) if source.is_override else f"{source}: {source.key} = {source.value}"
