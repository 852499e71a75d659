"""ZigZag with random delays on a perfect channel: while vehicles fly, both modes have the same events.

Positions agree only approximately. The engine's vehicles move continuously. The prototype's vehicles take a
step at each update of the positions (every 10 ms, so 0.1 m at 10 m/s), and a command takes effect at the next
update. So a vehicle is up to one step behind. After it turned around, it is up to two steps from its position
in the engine, until it waits at its next waypoint. (A second turn cancels the difference of the first one.)
Hence

- a message between two vehicles over a distance within 2 * (1 + 2) steps of the range may arrive in one mode
  only, and both are right;
- telemetry, which comes with an update, from a vehicle whose distance to a waypoint is within two steps of
  the mission's tolerance may say "there" in one mode only.

Such an event is called marginal. The tests run ZigZag up to the first one, which must be late enough, with
exchanges between vehicles before it. Up to there nothing may differ. Finer steps make marginal events
rarer.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any, cast

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.protocol.interface import IProtocol, IProvider
from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.mission_mobility import MissionMobilityConfiguration
from gradysim.protocol.position import Position
from gradysim.prototype.simulation import configure_mobility
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.schema.parameters import parametrize
from gradysim.simulator.handler.communication import CommunicationHandler, CommunicationMedium
from gradysim.simulator.handler.mobility import MasslessMobilityConfiguration, MasslessMobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration

FILE = Path(__file__).parents[3] / "configs" / "zigzag.ini"
RANGE_M = 50.0
SPEED_MPS = 10.0
MESSAGE_STEPS, TELEMETRY_STEPS = 6, 2
SPACING_M = 300.0
ALTITUDE_M = 20.0
TOLERANCE_M = MissionMobilityConfiguration().tolerance

CASES = [  # configuration, seed, time between two updates in seconds, seconds without a marginal event
    ("ZigZag5", 8, 0.01, 300),
    ("ZigZag5", 9, 0.01, 450),
    pytest.param(("ZigZag5", 1, 0.001, 700), marks=pytest.mark.verify),
    ("ZigZag15", 0, 0.01, 90),
    ("ZigZag15", 1, 0.001, 120),
]

Call = tuple[float, int, str, str]
"""Time in seconds, node, method, argument."""


@dataclass
class Recording:
    """Timers, messages and commands of all nodes in order, and the final state of each node."""

    calls: list[Call] = field(default_factory=list)
    positions: list[Position] = field(default_factory=list)
    tracked: list[dict[str, Any]] = field(default_factory=list)


def load(config: str, seed: int, duration_s: float) -> Scenario:
    (scenario,) = load_scenarios(
        FILE,
        config,
        overrides=[
            f"seed-set = {seed}",
            f"sim-time-limit = {duration_s}s",
            '*.radioMedium.typename = "UnitDiskRadioMedium"',
            f"**.wlan[*].radio.transmitter.communicationRange = {RANGE_M}m",
            f"*.communicationMedium.transmissionRange = {RANGE_M}m",
        ],
    )
    return scenario


def watched(
    scenario: Scenario,
    calls: list[Call],
    on_send: Callable[[int, CommunicationCommand], None] = lambda sender, command: None,
    on_telemetry: Callable[[int], None] = lambda node: None,
) -> Scenario:
    """Return the scenario with protocols that log callbacks and commands, and report marginal events."""

    def note_calls(provider: IProvider, name: str) -> None:
        method = getattr(provider, name)

        def noted(*arguments: Any) -> None:
            calls.append((provider.current_time(), provider.get_id(), name, repr(arguments)))
            method(*arguments)

        setattr(provider, name, noted)

    def watch(protocol: type[IProtocol]) -> type[IProtocol]:
        class Watched(protocol):  # type: ignore[misc, valid-type]
            @classmethod
            def instantiate(cls, provider: IProvider) -> IProtocol:
                send = provider.send_communication_command

                def watched_send(command: CommunicationCommand) -> None:
                    on_send(provider.get_id(), command)
                    send(command)

                provider.send_communication_command = watched_send  # type: ignore[method-assign]
                for name in ("send_communication_command", "send_mobility_command", "schedule_timer"):
                    note_calls(provider, name)
                return cast("IProtocol", super().instantiate(provider))

            def handle_timer(self, timer: str) -> None:
                calls.append((self.provider.current_time(), self.provider.get_id(), "handle_timer", timer))
                super().handle_timer(timer)

            def handle_packet(self, message: str) -> None:
                calls.append((self.provider.current_time(), self.provider.get_id(), "handle_packet", message))
                super().handle_packet(message)

            def handle_telemetry(self, telemetry: Telemetry) -> None:
                on_telemetry(self.provider.get_id())
                super().handle_telemetry(telemetry)

        return Watched

    classes = {spec.protocol: watch(spec.protocol) for spec in scenario.nodes}
    return replace(
        scenario, nodes=tuple(replace(spec, protocol=classes[spec.protocol]) for spec in scenario.nodes)
    )


def first_marginal_s(scenario: Scenario, update_s: float) -> float:
    """Return the time of the first marginal event, or the end of the run."""
    step_m = SPEED_MPS * update_s
    times = [scenario.sim_time_limit_s]

    def position(node: int) -> Position:
        return run._nodes[node].position

    def note(distance_m: float, limit_m: float, steps: int) -> None:
        if abs(distance_m - limit_m) <= steps * step_m:
            times.append(run._network.now)

    def on_send(sender: int, command: CommunicationCommand) -> None:
        everybody = range(len(scenario.nodes))
        for receiver in everybody if command.destination is None else [command.destination]:
            note(math.dist(position(sender), position(receiver)), RANGE_M, MESSAGE_STEPS)

    def on_telemetry(node: int) -> None:
        x, y, z = position(node)
        stop = round(x / SPACING_M) * SPACING_M
        note(math.dist((x, y, z), (stop, 0.0, ALTITUDE_M + node)), TOLERANCE_M, TELEMETRY_STEPS)

    run = IntegratedRun(watched(scenario, [], on_send, on_telemetry))
    run.execute()
    return min(times)


def fly_integrated(scenario: Scenario) -> Recording:
    recording = Recording()
    run = IntegratedRun(watched(scenario, recording.calls))
    run.execute()
    result = run.result()
    recording.positions = [node.position for node in result.nodes]
    recording.tracked = [dict(node.tracked_variables) for node in result.nodes]
    return recording


def fly_prototype(scenario: Scenario, update_s: float) -> Recording:
    recording = Recording()
    scenario = watched(scenario, recording.calls)
    mobility = MasslessMobilityHandler(MasslessMobilityConfiguration(update_rate=update_s))
    for spec in scenario.nodes:
        configure_mobility(mobility, spec)
    builder = SimulationBuilder(
        SimulationConfiguration(
            duration=scenario.sim_time_limit_s, seed=scenario.seed, execution_logging=False
        )
    )
    builder.add_handler(CommunicationHandler(CommunicationMedium(transmission_range=RANGE_M)))
    builder.add_handler(TimerHandler()).add_handler(mobility)
    for spec in scenario.nodes:
        builder.add_node(parametrize(spec.protocol, spec.protocol_parameters), spec.initial_position)
    simulator = builder.build()
    simulator.start_simulation()
    recording.positions = [node.position for node in simulator.nodes]
    recording.tracked = [
        dict(node.protocol_encapsulator.provider.tracked_variables) for node in simulator.nodes
    ]
    return recording


@cache
def both(config: str, seed: int, update_s: float, least_s: float) -> tuple[Recording, Recording]:
    """Run both modes up to shortly before the first marginal event."""
    end_s = first_marginal_s(load(config, seed, 2 * least_s), update_s)
    assert end_s > least_s, f"a marginal event at {end_s} s: choose another seed"
    scenario = load(config, seed, math.ceil(end_s) - 1)
    return fly_integrated(scenario), fly_prototype(scenario, update_s)


@pytest.mark.parametrize("case", CASES)
def test_the_same_timers_messages_and_commands_in_the_same_order(case: tuple[str, int, float, float]) -> None:
    integrated, prototype = both(*case)
    assert [call[1:] for call in integrated.calls] == [call[1:] for call in prototype.calls]


@pytest.mark.parametrize("case", CASES)
def test_at_the_same_times(case: tuple[str, int, float, float]) -> None:
    integrated, prototype = both(*case)
    expected = [call[0] for call in prototype.calls]
    assert [call[0] for call in integrated.calls] == pytest.approx(expected, rel=0, abs=1e-12)


@pytest.mark.parametrize("case", CASES)
def test_the_same_variables(case: tuple[str, int, float, float]) -> None:
    integrated, prototype = both(*case)
    assert integrated.tracked == prototype.tracked


@pytest.mark.parametrize("case", CASES)
def test_vehicles_end_in_the_same_places_but_for_some_steps(case: tuple[str, int, float, float]) -> None:
    integrated, prototype = both(*case)
    distances_m = list(map(math.dist, integrated.positions, prototype.positions))
    assert max(distances_m) <= MESSAGE_STEPS / 2 * SPEED_MPS * case[2]


@pytest.mark.parametrize("case", CASES)
def test_vehicles_have_turned_around_by_then(case: tuple[str, int, float, float]) -> None:
    integrated, _ = both(*case)
    assert sum(node.get("interactions", 0) for node in integrated.tracked) > 2
