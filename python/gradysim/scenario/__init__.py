"""Scenarios in .ini files: the grammar of OMNeT++, the names of INET, and errors with source and expectation.

`load_scenarios` reads a file in these steps:

    ini, sections                the text as sections and entries, and the sections of a configuration
    sweep, combinations, runs    iteration variables, and the runs of all their values
    lines, groups, resolution    the rows of a run: which line sets which parameter
    unknown_keys                 keys that match nothing: lines without a row
    nodes, interfaces, obstacles the parts of a Scenario, built from rows
    networks, coverage           the networks of runs, and which of them are checked before the first run
    lint                         settings that are valid but probably not intended

`errors` has the exceptions, `schema` and `keys` the keys that a file may have.
"""

from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.load import load_scenarios
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.parameters import parametrize
from gradysim.scenario.scenario import CommunicationMediumSpec, Scenario
from gradysim.scenario.values import Setting

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
