"""Scenarios in .ini files: the grammar of OMNeT++, the names of INET, and errors with place and expectation.

`load_scenarios` reads a file in these steps:

    ini                          the text as sections and entries
    runs, value                  iterations, and the text of one value
    lookup, groups               the entries in force, and the groups of nodes
    unknown_keys                 keys that match nothing
    protocols, parameters        the classes of the nodes and their parameters
    nodes, interfaces, network   the parts of a Scenario
    lint                         settings that are valid but probably not intended

`errors` has the exceptions, `schema` and `keys` the keys that a file may have.
"""

from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.load import load_scenarios
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.parameters import parametrize
from gradysim.scenario.scenario import CommunicationMediumSpec, Scenario
from gradysim.scenario.settings import Setting

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
