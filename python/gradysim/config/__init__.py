"""Scenarios in .ini files: OMNeT++'s grammar, INET's names, and errors that say where and what was expected.

Text goes through one stage after the other: reader, sections, variables, lookup (patterns), groups and nodes,
with values read by keys, kinds, expression, quantity and units. What comes out is a list of Scenario.
"""

from gradysim.config.error import ConfigError, format_config_error
from gradysim.config.protocol_class import parametrize
from gradysim.config.scenario import (
    CommunicationMediumSpec,
    NodeSpec,
    Scenario,
    Setting,
    Source,
    load_scenarios,
)

__all__ = [
    "CommunicationMediumSpec",
    "ConfigError",
    "NodeSpec",
    "Scenario",
    "Setting",
    "Source",
    "format_config_error",
    "load_scenarios",
    "parametrize",
]
