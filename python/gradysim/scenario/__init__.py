"""Scenarios in .ini files: OMNeT++'s grammar, INET's names, and errors that say where and what was expected.

`load_scenarios` takes a file through the sub-packages, each of which imports only those above it:

    errors                what all others say of a mistake
    file                  the text as sections and entries
    value                 the text of one value
    keys, protocol        what may be set, and what the nodes run
    matching              which entry is in force for what
    runs, node, obstacle  the parts of a Scenario
    doubts                what is valid and probably not meant

`load` reads one `scenario` after the other, `networks` the part of each, `network`, that runs may share.
"""

from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.load import load_scenarios
from gradysim.scenario.node.node_spec import NodeSpec
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
