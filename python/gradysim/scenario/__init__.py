"""Scenarios in .ini files: the grammar of OMNeT++, the names of INET, and errors with source and expectation.

`load_scenarios` reads a file in these steps:

    parse      the text as sections and entries, and the values of expressions
    schema     the keys that a file may have, and the types of their values
    resolve    the runs of a configuration, and the rows of each: which line sets which parameter
    build      the parts of a Scenario, built from rows
    lint       settings that are valid but probably not intended

"""

from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.load import load_scenarios
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.scenario import CommunicationMediumSpec, Scenario
from gradysim.scenario.schema.parameters import parametrize
from gradysim.scenario.schema.values import Setting

__all__ = [
    "CommunicationMediumSpec",
    "ConfigError",
    "NodeSpec",
    "Scenario",
    "Setting",
    "Source",
    "load_scenarios",
    "parametrize",
]
