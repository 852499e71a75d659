"""A scenario as a network of the compiled engine.

Settings of the scenario have the names of the fields of the engine's structs. They are set one by one. An
error of the engine's validation is reported at its line of the .ini file.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

from gradysim.encapsulator.autopilots import check_autopilots
from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.engine_errors import errors_at, settings_by_target, text_of
from gradysim.integrated.native_protocols import is_native, set_native_protocol
from gradysim.integrated.power_for_range import PowersForRanges
from gradysim.scenario.errors import ConfigError, ErrorCollector
from gradysim.scenario.node_spec import InterfaceSpec, NodeSpec
from gradysim.scenario.obstacle_spec import ObstacleSpec
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.keys import DEFAULT_INTERFACE
from gradysim.scenario.schema.values import Setting

if TYPE_CHECKING:
    from gradysim._netsim import MediumConfig, Network, Node, NodeConfig, ObstacleConfig


def build_network(scenario: Scenario) -> tuple["Network", tuple["Node", ...]]:
    """Return the network of `scenario` and its nodes in the order of their ids, without protocols in Python.

    Raises ConfigError, with the source in the .ini file, if a value is outside the engine's range.
    """
    try:
        return _built(scenario)
    except ConfigError as error:
        raise _with_other_errors(error, scenario) from error


def _built(scenario: Scenario) -> tuple["Network", tuple["Node", ...]]:
    config = medium_config(scenario)
    with errors_at(settings_by_target("medium", scenario.medium)):
        network: Network = load_netsim().Network(config, scenario.seed)
    powers = PowersForRanges(config)
    nodes = tuple(add_node(network, spec, powers, scenario.medium, scenario.wind) for spec in scenario.nodes)
    for spec, node in zip(scenario.nodes, nodes, strict=True):
        if is_native(spec):
            _check_clock(spec)
            set_native_protocol(node, spec)
    return network, nodes


def _check_clock(spec: NodeSpec) -> None:
    if spec.drift_rate:
        text = (
            f"{spec.name} runs {spec.protocol.__name__}, a protocol of the engine, without a clock of its own"
        )
        raise ConfigError.at(
            spec.node["drift_rate_ppm"].source, text, expected="0ppm, or a protocol in Python"
        )


def _with_other_errors(first: ConfigError, scenario: Scenario) -> ConfigError:
    """Return the errors of the medium and of one node of each kind, together with the first error."""
    errors = ErrorCollector()
    errors.add(first)
    network: Network | None = None
    with errors.collecting(), errors_at(settings_by_target("medium", scenario.medium)):
        medium = medium_config(scenario)
        network = load_netsim().Network(medium, scenario.seed)
        powers = PowersForRanges(medium)
    for spec in one_of_each_kind(scenario.nodes):
        with errors.collecting():
            if network is None:
                node_config(spec)
            else:
                add_node(network, spec, powers, scenario.medium, scenario.wind)
    return errors.combined()


def by_kind(nodes: Iterable[NodeSpec]) -> Mapping[object, Sequence[NodeSpec]]:
    """Group nodes by their settings. Nodes with the same effective lines share their mappings.

    A result for one node of a group holds for all.
    """
    kinds: dict[object, list[NodeSpec]] = {}
    for spec in nodes:
        settings = (spec.protocol_sources, spec.mobility, spec.computer, *spec.wlan)
        kind = (spec.group, *map(id, settings))
        kinds.setdefault(kind, []).append(spec)
    return kinds


def one_of_each_kind(nodes: Iterable[NodeSpec]) -> Iterable[NodeSpec]:
    """Return the first node of each kind."""
    return [specs[0] for specs in by_kind(nodes).values()]


def check_scenario(scenario: Scenario) -> None:
    """Raise ConfigError, with the source in the .ini file, if a value is outside the engine's range.

    Building the network makes the same checks. Use this function to check a study before its first run.
    """
    build_network(scenario)
    check_autopilots(scenario)


def add_node(
    network: "Network",
    spec: NodeSpec,
    powers: PowersForRanges,
    medium: Mapping[str, Setting],
    wind: Mapping[str, float],
) -> "Node":
    """Add one node to `network`. Raise the errors that depend on the whole configuration."""
    config = node_config(spec)
    for field, value in wind.items():
        setattr(config.wind, field, value)
    with node_errors_at(spec, medium):
        powers.set_powers(config, spec)
        return network.add_node(config)


def medium_config(scenario: Scenario) -> "MediumConfig":
    """Return the validated configuration of the medium. Its type sets the defaults of its other fields."""
    netsim = load_netsim()
    settings = dict(scenario.medium)
    chosen = settings.pop("typename", None)
    with errors_at(settings_by_target("medium", scenario.medium)):
        config: MediumConfig = netsim.MediumConfig() if chosen is None else netsim.MediumConfig(chosen.value)
        set_fields(config, settings)
        config.obstacles = _obstacle_configs(scenario)
        config.validate()
    return config


def _obstacle_configs(scenario: Scenario) -> "list[ObstacleConfig]":
    """Return the validated configurations of all obstacles. ConfigError names all invalid ones."""
    errors = ErrorCollector()
    configs = []
    for spec in scenario.obstacles:
        with errors.collecting():
            configs.append(obstacle_config(spec))
    errors.raise_all()
    return configs


def obstacle_config(spec: ObstacleSpec) -> "ObstacleConfig":
    """Return the validated configuration of one obstacle."""
    netsim = load_netsim()
    config: ObstacleConfig = netsim.ObstacleConfig()
    config.name = spec.name
    config.rings = spec.rings
    config.base_m = spec.base_m
    config.top_m = spec.top_m
    config.material = spec.material
    config.relative_permittivity = spec.relative_permittivity
    config.conductivity_spm = spec.conductivity_spm
    try:
        config.validate()
    except netsim.ConfigError as error:
        raise ConfigError.at(
            replace(spec.source, part=spec.name), f"{spec.name}: {text_of(error)}"
        ) from error
    return config


def node_config(spec: NodeSpec) -> "NodeConfig":
    """Return the validated configuration of one node. Its interfaces set the defaults of their radios."""
    config: NodeConfig = load_netsim().NodeConfig(spec.name, [_typename(wlan) for wlan in spec.wlan])
    for interface, wlan in zip(config.wlan, spec.wlan, strict=True):
        set_fields(interface.radio, wlan.radio)
        set_fields(interface.radio.antenna, wlan.antenna)
        set_fields(interface.mac, wlan.mac)
        set_fields(interface.csma, wlan.csma)
    set_fields(config.mobility, spec.mobility)
    if spec.autopilot is not None:  # its vehicle has a delay of its own; the engine moves the node after it
        config.mobility.command_delay_s = 0
    set_fields(config.computer, spec.computer)
    config.initial_position = spec.initial_position
    with node_errors_at(spec, {}):
        config.validate()
    return config


def _typename(wlan: InterfaceSpec) -> str:
    chosen = wlan.interface.get("typename")
    return DEFAULT_INTERFACE if chosen is None else str(chosen.value)


@contextmanager
def node_errors_at(spec: NodeSpec, medium: Mapping[str, Setting]) -> Iterator[None]:
    """Turn an error of the engine about a node into a ConfigError, at the line that causes it."""
    try:
        yield
    except load_netsim().ConfigError as error:
        with errors_at(node_settings(spec, error.interface or 0, medium)):
            raise


def node_settings(spec: NodeSpec, interface: int, medium: Mapping[str, Setting]) -> dict[str, Setting]:
    """Return the settings of one interface of a node and of its context, by target."""
    settings = settings_by_target("medium", medium)
    for of_node in ("node", "mobility", "computer"):
        settings |= settings_by_target(of_node, getattr(spec, of_node))
    for struct, fields in spec.wlan[interface].structs().items():
        settings |= settings_by_target(struct, fields)
    return settings


def set_fields(config: object, settings: Mapping[str, Setting]) -> None:
    """Set the fields of a struct of the engine."""
    for field, setting in settings.items():
        try:
            setattr(config, field, setting.value)
        except (TypeError, OverflowError) as error:
            text = f"{setting.value!r} does not fit the engine's field {field}"
            raise ConfigError.at(setting.source, text) from error
