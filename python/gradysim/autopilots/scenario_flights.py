"""From what a scenario says of its nodes to autopilots that fly them."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from gradysim.protocol.position import Position
from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.native_protocols import NativeProtocol
from gradysim.scenario.node.autopilot_spec import AutopilotSpec
from gradysim.scenario.node.node_spec import NodeSpec
from gradysim.scenario.scenario import Scenario
from gradysim.sitl.arducopter import find_arducopter
from gradysim.sitl.dialect import load_dialect
from gradysim.sitl.error import SitlError
from gradysim.sitl.flown_node import FlownNode, check_start, wind_mps
from gradysim.sitl.unprivileged import user_for

if TYPE_CHECKING:
    from gradysim.sitl.flights import Flights


def check_autopilots(scenario: Scenario) -> None:
    """Raise ConfigError, with the place in the .ini file, for what keeps a node from being flown.

    Raises:
        ConfigError: There is no program, one of the nodes cannot be flown by it, or the extra `sitl` is not
            installed.
    """
    for spec in scenario.nodes:
        if spec.autopilot is not None:
            _check(spec, spec.autopilot, scenario.reference_coordinates)


def flights_of(scenario: Scenario, on_text: Callable[[str, str], None] | None = None) -> "Flights | None":
    """Return the flights of all nodes that autopilots fly, not begun; None if there are no such nodes.

    Args:
        scenario: A checked one.
        on_text: Called with a node's name and what its autopilot says.

    Raises:
        ConfigError: As `check_autopilots`.
    """
    check_autopilots(scenario)
    if all(spec.autopilot is None for spec in scenario.nodes):
        return None
    from gradysim.sitl.flights import Flights

    nodes = [_flown(spec, spec.autopilot) for spec in scenario.nodes if spec.autopilot is not None]
    return Flights(nodes, scenario.reference_coordinates, on_text=on_text)


def _flown(spec: NodeSpec, autopilot: AutopilotSpec) -> FlownNode:
    return FlownNode(
        id=spec.id,
        name=f"node {spec.id} ({spec.name})",
        start=spec.initial_position,
        speed_mps=autopilot.speed_mps,
        program=autopilot.program,
        user=autopilot.user,
        parameters=autopilot.parameters,
    )


def _check(spec: NodeSpec, autopilot: AutopilotSpec, reference: Position) -> None:
    if issubclass(spec.protocol, NativeProtocol):
        text = f"{spec.name}: an autopilot obeys protocols in Python only; expected another mobility.typename"
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
