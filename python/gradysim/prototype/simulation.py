"""A scenario as a simulation of the plain simulator in Python."""

import dataclasses
from collections.abc import Iterable, Mapping
from typing import Any

from gradysim.encapsulator.autopilots import flights_of
from gradysim.encapsulator.clock import let_clock_drift
from gradysim.encapsulator.tracked_variables import watch_tracked_variables
from gradysim.motion.flight_controller import Airframe
from gradysim.motion.wind import Wind
from gradysim.protocol.defaults import LEAST_TELEMETRY_INTERVAL_S, UPDATE_S
from gradysim.protocol.interface import IProvider
from gradysim.prototype.replay import PrototypeRecorder, precede
from gradysim.results.files import run_name
from gradysim.results.recorder import NodeRecorder
from gradysim.scenario.build.paths import path_of
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.ranges import ranges_of_prototype_m
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.keys import MASSLESS, QUADCOPTER, STATIONARY
from gradysim.scenario.schema.native_protocols import NativeProtocol, text_of_only_integrated
from gradysim.scenario.schema.parameters import parametrize
from gradysim.simulator.handler.communication import CommunicationHandler, CommunicationMedium, DeliveryLedger
from gradysim.simulator.handler.computer import ComputerHandler, ProcessingTime
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.mobility import MasslessMobilityConfiguration, MasslessMobilityHandler
from gradysim.simulator.handler.mobility.massless import IdleSkippingMobilityHandler
from gradysim.simulator.handler.mobility.quadcopter import QuadcopterMobilityHandler
from gradysim.simulator.handler.registry import handlers_by_label
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.node import Node
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration, Simulator


def build_simulation(
    scenario: Scenario,
    handlers: Iterable[INodeHandler] = (),
    real_time: bool | float = False,
    recorders: Mapping[int, NodeRecorder] | None = None,
    replay: PrototypeRecorder | None = None,
) -> tuple[Simulator, DeliveryLedger]:
    """Return the simulation of `scenario`, ready to run, and the ledger of its messages.

    `handlers` are added to those of communication, timers and mobility, and called after them. `real_time` is
    the setting of `SimulationConfiguration`. `recorders` record vectors of nodes, by id. `replay` records the
    run.

    Raises ConfigError if a value is outside the simulator's range, and ValueError or TypeError if a handler
    cannot be added. Also raises exceptions of protocol constructors, and SitlError if an autopilot does not
    start or a step of a flight failed.
    """
    check_protocols(scenario)
    world = "its {label} handler follows from the scenario"
    given = handlers_by_label(handlers, "prototype mode", world, asynchronous=True)
    times = processing_times(scenario)
    ledger = DeliveryLedger(has_computers=bool(times))
    computers = ComputerHandler(times, ledger)
    communication = communication_handler(scenario, ledger)
    builder = SimulationBuilder(
        SimulationConfiguration(
            duration=scenario.sim_time_limit_s,
            real_time=real_time,
            seed=scenario.seed,
            execution_logging=False,
        )
    )
    # Idle updates are not skipped if handlers count events, or if the wall clock paces them.
    mobility = mobility_handler(scenario, skips_idle=not given and not real_time)
    if replay is not None:
        replay.watch_messages(communication)
        replay.watch_paths(mobility, scenario)
    builder.add_handler(communication).add_handler(TimerHandler()).add_handler(mobility)
    if times:
        builder.add_handler(computers)
    for handler in given.values():
        builder.add_handler(handler)
    for spec in scenario.nodes:
        protocol = parametrize(spec.protocol, spec.protocol_parameters)
        builder.add_node(protocol, spec.initial_position, spec.name)
    name = run_name(scenario, "prototype")
    recorded = recorders or {}

    def prepare(node: Node[Any]) -> None:
        provider = node.protocol_encapsulator.provider
        provider.run_name = name
        provider.has_telemetry = scenario.nodes[node.id].has_telemetry
        let_clock_drift(provider, scenario.nodes[node.id].drift_rate)
        if replay is not None:
            replay.watch_node(node)
        computers.prepare(node)
        record_node(node, recorded.get(node.id), replay)

    simulator = builder.prepare_nodes(prepare).build()
    simulator.writes_log = False
    if isinstance(mobility, QuadcopterMobilityHandler):
        mobility.take_off()
    return simulator, ledger


def check_scenario(scenario: Scenario) -> None:
    """Raise ConfigError, with the source in the .ini file, when a value is outside the simulator's range.

    Building the simulation makes the same checks. Use this function to check a study before its first run.
    """
    check_protocols(scenario)
    communication_handler(scenario)
    mobility_handler(scenario)


def check_protocols(scenario: Scenario) -> None:
    """Raise ConfigError for the first node whose protocol only the engine can run."""
    for spec in scenario.nodes:
        if issubclass(spec.protocol, NativeProtocol):
            text = f"{spec.name}: {text_of_only_integrated(spec.protocol, 'prototype mode')}"
            raise ConfigError(text, spec.protocol_sources.get(""))


def mobility_handler(scenario: Scenario, *, skips_idle: bool = False) -> MasslessMobilityHandler:
    """Return the mobility handler; with `skips_idle`, it has no events while nothing moves.

    Raises ConfigError when a value is outside its range.
    """
    configuration = MasslessMobilityConfiguration(reference_coordinates=scenario.reference_coordinates)
    flights = flights_of(scenario)
    quadcopters = {spec.id: airframe_of(spec) for spec in scenario.nodes if spec.is_quadcopter}
    wind = Wind(**scenario.wind)
    mobility: MasslessMobilityHandler
    if flights is not None or quadcopters:  # they fly in steps of 10 ms, in both modes
        mobility = QuadcopterMobilityHandler(configuration, quadcopters, wind, flights)
    else:
        configuration.update_rate = update_rate_s(scenario.nodes)
        mobility = (IdleSkippingMobilityHandler if skips_idle else MasslessMobilityHandler)(configuration)
    for spec in scenario.nodes:
        configure_mobility(mobility, spec)
    return mobility


def processing_times(scenario: Scenario) -> dict[int, ProcessingTime]:
    """Return the processing times of the nodes whose computers take time, by id."""
    spreads = (spec.computer.get("processing_time_spread") for spec in scenario.nodes)
    return {
        spec.id: ProcessingTime(spec.processing_time_s, 0.0 if spread is None else float(spread.value))
        for spec, spread in zip(scenario.nodes, spreads, strict=True)
        if spec.processing_time_s > 0
    }


def airframe_of(spec: NodeSpec) -> Airframe:
    """Return the vehicle of a node. Its reader has checked the values."""
    given = {field.name: spec.mobility.get(field.name) for field in dataclasses.fields(Airframe)}
    return Airframe(**{name: float(setting.value) for name, setting in given.items() if setting is not None})


def update_rate_s(nodes: Iterable[NodeSpec]) -> float:
    """Return the time between two updates of all positions: 10 ms, or the shortest telemetry interval."""
    given = (spec.mobility.get("telemetry_interval_s") for spec in nodes)
    intervals_s = [float(interval.value) for interval in given if interval is not None and interval.value]
    return max(min([UPDATE_S, *intervals_s]), LEAST_TELEMETRY_INTERVAL_S)


def communication_handler(scenario: Scenario, ledger: DeliveryLedger | None = None) -> CommunicationHandler:
    """Return the handler of messages. Raises ConfigError when a value of the medium is outside its range."""
    spec = scenario.communication_medium
    ranges_m = ranges_of_prototype_m(scenario)
    try:
        media = {
            range_m: CommunicationMedium(range_m, spec.delay_s, spec.failure_rate)
            for range_m in set(ranges_m)
        }
    except ValueError as error:
        raise ConfigError(f"{scenario.file}: *.communicationMedium: {error}") from error
    handler = CommunicationHandler(media[ranges_m[0]], ledger)
    if len(media) > 1:
        handler.medium_of = dict(enumerate(map(media.__getitem__, ranges_m)))
    return handler


def configure_mobility(mobility: MasslessMobilityHandler, spec: NodeSpec) -> None:
    """Set how one node moves. Raises ConfigError, with its source, when a value is outside its range."""
    typename = spec.mobility.get("typename")
    stationary = typename is not None and typename.value == STATIONARY
    path = path_of(spec.mobility, spec.initial_position)
    if typename is not None and path is None and typename.value not in (MASSLESS, QUADCOPTER, STATIONARY):
        expected = f'expected "{MASSLESS}", "{QUADCOPTER}" or "{STATIONARY}"'
        raise ConfigError.at(typename.source, f"prototype mode has no {typename.value}; {expected}")
    numbers = {"telemetry_interval": UPDATE_S}  # the default, for any interval of other nodes
    mobility.configure_node(spec.id, stationary=stationary, path=path, **numbers)
    for argument, field in (
        ("speed", "speed_mps"),
        ("telemetry_interval", "telemetry_interval_s"),
        ("position_error", "position_error_m"),
        ("position_error_time", "position_error_time_s"),
        ("position_error_ratio", "position_error_ratio"),
        ("command_delay", "command_delay_s"),
    ):
        if (setting := spec.mobility.get(field)) is not None:
            numbers[argument] = float(setting.value)
            try:
                mobility.configure_node(spec.id, stationary=stationary, path=path, **numbers)
            except ValueError as error:  # the earlier ones are valid
                raise ConfigError.at(setting.source, str(error)) from error


_PS_PER_S = 1e12


def record_node(
    node: Node[Any], recorder: NodeRecorder | None, replay: PrototypeRecorder | None = None
) -> None:
    """Record a node. Call it before the protocol is made, which may keep `tracked_variables`."""
    provider: IProvider = node.protocol_encapsulator.provider
    is_replayed = replay is not None and replay.is_recorded(node.id)
    if recorder is None and not is_replayed:
        return

    def now_ps() -> int:
        return round(provider.current_time() * _PS_PER_S)

    def variable_set(name: str, value: object) -> None:
        if recorder is not None:
            recorder.variable_set(now_ps(), name, value)
        if replay is not None:
            replay.close_if_long()
            replay.variable_set(node.id, name, value)

    watch_tracked_variables(provider, variable_set)
    if recorder is not None:
        # Before the protocol gets its telemetry.
        precede(
            node.protocol_encapsulator,
            "handle_telemetry",
            lambda _: recorder.position_told(now_ps(), *node.position),
        )
