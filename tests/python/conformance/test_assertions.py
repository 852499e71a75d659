"""The same assertions hold, and fail, in both modes."""

import importlib
import re
from collections.abc import Callable
from typing import Any

import pytest
from perfect_channel import Case

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.simulator.handler.assertion import (
    AssertionHandler,
    FailedAssertionException,
    SimulationTestCase,
    assert_always_true_for_protocol,
    assert_always_true_for_simulation,
    assert_eventually_true_for_protocol,
    assert_eventually_true_for_simulation,
)
from gradysim.simulator.node import Node

CASE = Case([(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)], telemetry_interval_s=0.01, duration_s=2.0)
Check = Callable[..., None]


class Climbing(IProtocol):
    """Climbs at 10 m/s to 10 m, and sends a message to the other node after 0.5 s."""

    def initialize(self) -> None:
        self.heard = 0
        x = 10.0 * self.provider.get_id()
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(x, 0, 10))
        self.provider.schedule_timer("talk", 0.5)

    def handle_timer(self, timer: str) -> None:
        if self.provider.get_id() == 0:
            self.provider.send_communication_command(BroadcastMessageCommand("climbing"))

    def handle_packet(self, message: str) -> None:
        self.heard += 1

    def handle_telemetry(self, telemetry: Telemetry) -> None: ...

    def finish(self) -> None: ...


@pytest.fixture(params=["integrated", "prototype"])
def check(request: pytest.FixtureRequest) -> Check:
    """`check(*cases, protocol)`: run with these assertions."""
    module: Any = importlib.import_module(f"gradysim.{request.param}.run")

    def run(*cases: type[SimulationTestCase], protocol: type[IProtocol] = Climbing, **options: Any) -> None:
        module.run(CASE.scenario(protocol), handlers=[AssertionHandler(cases)], **options)

    return run


def below(height: float) -> type[SimulationTestCase]:
    @assert_always_true_for_protocol(Climbing, f"below {height:g} m")
    def is_below(node: Node[Climbing]) -> bool:
        return node.position[2] <= height

    return is_below


def heard_by(*nodes: int) -> type[SimulationTestCase]:
    @assert_eventually_true_for_protocol(Climbing, "it is heard")
    def is_heard(node: Node[Climbing]) -> bool:
        return node.protocol_encapsulator.protocol.heard > 0 or node.id not in nodes

    return is_heard


def together(height: float) -> type[SimulationTestCase]:
    @assert_always_true_for_simulation("they climb together", f"up to {height:g} m")
    def are_together(nodes: list[Node[Any]]) -> bool:
        heights = [node.position[2] for node in nodes]
        # In prototype mode the nodes move in turn, by 10 cm.
        return max(heights) - min(heights) < 0.11 and max(heights) <= height

    return are_together


def one_above(height: float) -> type[SimulationTestCase]:
    @assert_eventually_true_for_simulation("up there")
    def is_above(nodes: list[Node[Any]]) -> bool:
        return any(node.position[2] > height for node in nodes)

    return is_above


def test_what_is_true_holds(check: Check) -> None:
    check(below(10.001), heard_by(1), together(10.001), one_above(9.9))


def test_what_is_not_always_true_of_a_node_fails_with_the_node_and_the_time(check: Check) -> None:
    with pytest.raises(FailedAssertionException) as failure:
        check(below(5))
    text = str(failure.value)
    assert re.match(r'.*"below 5 m" .* node 0 \(Climbing 0\): \[iteration=', text)
    (time,) = re.findall(r"timestamp=([\d.]+)", text)
    assert float(time) == pytest.approx(0.5, abs=0.021)


def test_what_never_becomes_true_of_a_node_fails_with_the_node(check: Check) -> None:
    expected = (
        'Assertion "it is heard" failed for node 0 (Climbing 0): '
        "the condition was never met during the simulation"
    )
    with pytest.raises(FailedAssertionException, match=re.escape(expected)):
        check(heard_by(0, 1))


def test_what_is_not_always_true_of_all_fails_with_the_time(check: Check) -> None:
    with pytest.raises(FailedAssertionException, match=r"together\" \(up to 8 m\) .*timestamp=0\.[78]"):
        check(together(8))


def test_what_never_becomes_true_of_all_fails(check: Check) -> None:
    with pytest.raises(FailedAssertionException, match='"up there"'):
        check(one_above(11))


def test_nodes_of_another_protocol_are_not_asked(check: Check) -> None:
    class Other(Climbing): ...

    @assert_always_true_for_protocol(Other, "impossible")
    def impossible(node: Node[Other]) -> bool:
        return False

    check(impossible)
    with pytest.raises(FailedAssertionException):
        check(impossible, protocol=Other)


def test_the_protocols_failure_is_the_only_one_that_is_told(
    check: Check, caplog: pytest.LogCaptureFixture
) -> None:
    class Failing(Climbing):
        def handle_packet(self, message: str) -> None:
            raise LookupError("spoilt")

    with pytest.raises(LookupError, match="spoilt"):
        check(heard_by(0, 1), one_above(11), protocol=Failing)
    assert [record for record in caplog.records if record.levelname == "ERROR"] == []


def test_nobody_judges_what_a_stopped_run_would_have_come_to(check: Check) -> None:
    check(heard_by(0, 1), one_above(11), should_stop=lambda: True)


@pytest.mark.parametrize("mode", ["integrated", "prototype"])
def test_what_a_run_does_not_take(mode: str) -> None:
    module: Any = importlib.import_module(f"gradysim.{mode}.run")
    scenario = CASE.scenario(Climbing)
    with pytest.raises(TypeError, match="INodeHandler"):
        module.run(scenario, handlers=[AssertionHandler])
    with pytest.raises(ValueError, match="'assertion'"):
        module.run(scenario, handlers=[AssertionHandler([]), AssertionHandler([])])
