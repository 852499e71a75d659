"""Checks whether values of the file are values here."""

from collections.abc import Mapping

from gradysim.scenario.errors import ConfigError
from gradysim.scenario.parse.expressions import ParameterContext
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.resolve.sweep import name_iterations
from gradysim.scenario.schema.parameter_types import ParameterType
from gradysim.scenario.schema.values import read_scalar


def wrong_value(entry: Entry, key: str, text: str, kinds: Mapping[str, ParameterType]) -> str:
    """Return what is wrong with a value; "" if nothing is, or if it cannot be decided here.

    Args:
        entry: The line of the file.
        key: Its key here.
        text: The value here.
        kinds: {path below a node: what its values are} of the parameters that the line is about.
    """
    changed = Entry(key, text, entry.source)
    try:
        (named,), variables = name_iterations([changed])
    except ConfigError:  # a variable of another line
        return ""
    values = [named.text]
    for variable in variables:
        name = f"${{{variable.name}}}"
        values = [value.replace(name, each) for value in values for each in variable.values]
    for value in values:
        for path, kind in kinds.items():
            if kind.is_file or "${" in value:
                continue
            try:
                read_scalar(Entry(key, value, entry.source), kind, "n", ParameterContext(0, f"n[0].{path}"))
            except ConfigError as error:
                return f"expected {error.expected}" if error.expected else error.problem
    return ""
