"""The power and the range of each radio, so that all levels of a ladder have the same ones.

Below the level with radios, a circle decides what arrives. Its radius is the distance at which half of the
frames arrive without noise, fading and interference. The power of each radio is that of the scenario at all
levels, even if the file sets a range and a level leaves out what the power depends on.
"""

from collections.abc import Mapping, Sequence

from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.network import medium_config, node_config, node_errors_at
from gradysim.integrated.power_for_range import MESSAGE_BYTES, PowersForRanges, range_of
from gradysim.results.tracked_variables import group_of
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.keys import has_radios


def power_settings(scenario: Scenario) -> list[str]:
    """Return "KEY=VALUE" settings of the transmission power of each interface.

    None on a medium without radios. Raises ConfigError, as the run does.
    """
    medium = medium_config(scenario)
    if not has_radios(medium.typename):
        return []
    powers = PowersForRanges(medium)
    values: dict[int, Sequence[str]] = {}
    for spec in scenario.nodes:
        config = node_config(spec)
        with node_errors_at(spec, scenario.medium):
            powers.set_powers(config, spec)
        values[spec.id] = [f"{interface.radio.tx_power_w!r}W" for interface in config.wlan]
    return _settings("power", scenario.nodes, values)


def range_settings(scenario: Scenario) -> list[str]:
    """Return "KEY=VALUE" settings of the range of each interface.

    `scenario` has a medium with radios, the settings of `power_settings`, and neither noise nor fading.
    Raises ConfigError, as the run does.
    """
    medium = medium_config(scenario)
    known: dict[object, Sequence[str]] = {}
    values: dict[int, Sequence[str]] = {}
    for spec in scenario.nodes:
        key = (*map(id, spec.wlan), spec.initial_position[2])
        if key not in known:
            config = node_config(spec)
            with node_errors_at(spec, scenario.medium):
                known[key] = [
                    f"{range_of(budget, budget.tx_power_w)!r}m"
                    for index in range(len(config.wlan))
                    for budget in [load_netsim().LinkBudget(medium, config, config, MESSAGE_BYTES, index)]
                ]
        values[spec.id] = known[key]
    return _settings("communicationRange", scenario.nodes, values)


def _settings(parameter: str, nodes: Sequence[NodeSpec], values: Mapping[int, Sequence[str]]) -> list[str]:
    """Return settings of a parameter of transmitters. `values` are those of the interfaces, by node.

    Groups with equal values have one line for all nodes.
    """
    groups: dict[str, list[NodeSpec]] = {}
    for spec in nodes:
        groups.setdefault(group_of(spec.name), []).append(spec)
    settings = []
    for group, members in groups.items():
        named = {spec.name: values[spec.id] for spec in members}
        if len(set(map(tuple, named.values()))) == 1:
            named = {group: values[members[0].id]}
        settings += [
            f"*.{name}.wlan[{index}].radio.transmitter.{parameter}={value}"
            for name, of_interfaces in named.items()
            for index, value in enumerate(of_interfaces)
        ]
    return settings
