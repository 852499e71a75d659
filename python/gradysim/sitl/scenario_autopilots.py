"""Autopilots of the nodes of a scenario, for both modes."""

from collections.abc import Iterator
from contextlib import contextmanager

from gradysim.motion.quadcopter import DRAG_KGPS
from gradysim.motion.wind import Wind, WindAtVehicle
from gradysim.protocol.position import Position
from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.node_spec import AutopilotSpec, NodeSpec
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.native_protocols import NativeProtocol
from gradysim.sitl import SitlError
from gradysim.sitl.arducopter import find_arducopter
from gradysim.sitl.autopilot_node import AutopilotNode, check_start, sets_wind, wind_mps
from gradysim.sitl.flights import Flights
from gradysim.sitl.mavlink import load_dialect
from gradysim.sitl.process import user_for


def check_autopilots(scenario: Scenario) -> None:
    """Check that the nodes of a scenario can be flown by their autopilots.

    ConfigError, at the line in the .ini file, if a program is missing, a node cannot be flown by it, or the
    extra `sitl` is not installed.
    """
    for spec in scenario.nodes:
        if spec.autopilot is not None:
            _check(spec, spec.autopilot, scenario.reference_coordinates)


def flights_of(scenario: Scenario) -> Flights:
    """Return the flights of all nodes with an autopilot, not started.

    ConfigError as `check_autopilots`.
    """
    check_autopilots(scenario)
    nodes = [
        _node_of(spec, spec.autopilot, scenario) for spec in scenario.nodes if spec.autopilot is not None
    ]
    return Flights(nodes, scenario.reference_coordinates)


def _node_of(spec: NodeSpec, autopilot: AutopilotSpec, scenario: Scenario) -> AutopilotNode:
    is_windy = scenario.wind and not sets_wind(autopilot.parameters)
    return AutopilotNode(
        id=spec.id,
        name=f"node {spec.id} ({spec.name})",
        start=spec.initial_position,
        speed_mps=autopilot.speed_mps,
        program=autopilot.program,
        user=autopilot.user,
        parameters=autopilot.parameters,
        drag_kgps=float(drag.value) if (drag := spec.mobility.get("drag_kgps")) is not None else DRAG_KGPS,
        wind=WindAtVehicle(Wind(**scenario.wind), scenario.seed, spec.id) if is_windy else None,
    )


def _check(spec: NodeSpec, autopilot: AutopilotSpec, reference: Position) -> None:
    if issubclass(spec.protocol, NativeProtocol):
        text = f"{spec.name}: autopilots work only with Python protocols; expected another mobility.typename"
        raise ConfigError.at(autopilot.source, text)
    with _errors_at(autopilot.source):
        load_dialect()
        check_start(spec.name, spec.initial_position, reference)
    with _errors_at(autopilot.parameters_source):
        wind_mps(spec.name, autopilot.parameters)
    with _errors_at(autopilot.program_source):
        find_arducopter(autopilot.program)
    with _errors_at(autopilot.user_source):
        user_for(autopilot.user)


@contextmanager
def _errors_at(source: Source) -> Iterator[None]:
    try:
        yield
    except (SitlError, ModuleNotFoundError) as error:
        raise ConfigError.at(source, str(error)) from error
