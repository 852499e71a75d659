"""Cost of integrated mode in addition to the users' Python code.

Two goals, each a ratio of CPU times taken in turn in one process:

- a whole run of ZigZag25 takes at most 1.25 times as long as its Python callbacks alone. The callbacks are
  recorded in one run and replayed against a provider that does nothing. Arguments and order are the same, so
  every protocol takes the same decisions;
- one callback through the proxy takes at most 1.5 times as long as a plain call from Python. The kernel's
  time for the event itself (a node without a protocol) is subtracted.
"""

import gc
import sys
from collections.abc import Callable
from pathlib import Path
from random import Random
from statistics import median
from time import process_time
from typing import Any

from findings import record
from gradysim import _netsim
from gradysim.encapsulator.netsim import NetsimProvider
from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.integrated.network import build_network
from gradysim.integrated.run import run
from gradysim.protocol.interface import IProtocol, IProvider
from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.schema.parameters import parametrize

CONFIG = Path(__file__).resolve().parents[2] / "configs" / "zigzag.ini"
Call = tuple[int, str, float, Any]  # node, method, simulated time in seconds, argument


class Recorder:
    """Records every call between the engine and a protocol."""

    def __init__(self, node: int, protocol: IProtocol, now: Callable[[], float], calls: list[Call]) -> None:
        self._node, self._protocol, self._now, self._calls = node, protocol, now, calls

    def initialize(self) -> None:
        self._protocol.initialize()

    def finish(self) -> None:
        self._protocol.finish()

    def handle_timer(self, timer: str) -> None:
        self._calls.append((self._node, "handle_timer", self._now(), timer))
        self._protocol.handle_timer(timer)

    def handle_packet(self, message: str) -> None:
        self._calls.append((self._node, "handle_packet", self._now(), message))
        self._protocol.handle_packet(message)

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self._calls.append((self._node, "handle_telemetry", self._now(), telemetry))
        self._protocol.handle_telemetry(telemetry)


class IdleProvider(IProvider):
    """Accepts every command and does nothing; returns the recorded time."""

    def __init__(self, node: int, seed: int) -> None:
        self.tracked_variables = {}
        self.time = 0.0
        self._id = node
        self._random = RandomStream(seed, node, Purpose.PROTOCOL)

    @property
    def random(self) -> Random:
        return self._random

    def send_communication_command(self, command: CommunicationCommand) -> None: ...
    def send_mobility_command(self, command: MobilityCommand) -> None: ...
    def schedule_timer(self, timer: str, timestamp: float) -> None: ...
    def cancel_timer(self, timer: str) -> None: ...

    def current_time(self) -> float:
        return self.time

    def get_id(self) -> int:
        return self._id


def record_calls(scenario: Scenario) -> list[Call]:
    """Run the scenario and return its callbacks."""
    calls: list[Call] = []
    network, nodes = build_network(scenario)
    for spec, node in zip(scenario.nodes, nodes, strict=True):
        provider = NetsimProvider(node, seed=scenario.seed, reference_coordinates=(0.0, 0.0, 0.0))
        protocol = parametrize(spec.protocol, spec.protocol_parameters).instantiate(provider)
        node.set_protocol(Recorder(node.id, protocol, node.current_time, calls), lambda failure, method: None)
    network.initialize()
    network.run_until(scenario.sim_time_limit_s)
    network.release_protocols()
    return calls


def replay(scenario: Scenario, calls: list[Call]) -> float:
    """Return the CPU seconds of the recorded callbacks alone."""
    providers = [IdleProvider(spec.id, scenario.seed) for spec in scenario.nodes]
    protocols = [
        parametrize(spec.protocol, spec.protocol_parameters).instantiate(provider)
        for spec, provider in zip(scenario.nodes, providers, strict=True)
    ]
    for protocol in protocols:
        protocol.initialize()
    took_s = 0.0
    for start in range(0, len(calls), 10_000):
        # Bound methods and times are prepared in advance, so that only the calls are timed.
        batch = [
            (providers[node], time, getattr(protocols[node], method), argument)
            for node, method, time, argument in calls[start : start + 10_000]
        ]
        begin = process_time()
        for provider, time, method, argument in batch:
            provider.time = time
            method(argument)
        took_s += process_time() - begin
    return took_s


def whole_run(hours: float, rounds: int) -> None:
    """Compare whole runs with their callbacks."""
    (scenario,) = load_scenarios(CONFIG, "ZigZag25", overrides=[f"sim-time-limit={hours}h"])
    calls = record_calls(scenario)
    gc.freeze()  # or the garbage collector would scan the recorded calls during the runs
    ratios = []
    for _ in range(rounds):
        callbacks_s = replay(scenario, calls)
        run_s = run(scenario).cpu_s
        ratios.append(run_s / callbacks_s)
        print(f"    run {run_s:.2f} s, its {len(calls)} callbacks {callbacks_s:.2f} s")
    print(f"ZigZag25 over {hours} h / its callbacks by themselves: {median(ratios):.2f} (goal: at most 1.25)")


class Counting:
    """Minimal protocol."""

    calls = 0

    def initialize(self) -> None: ...
    def finish(self) -> None: ...

    def handle_timer(self, timer: str) -> None:
        self.calls += 1


def timers(count: int, protocol: Counting | None) -> float:
    """Return the CPU seconds of `count` timer events, in batches of 1,000 pending ones."""
    network = _netsim.Network(_netsim.MediumConfig(), 1)
    config = _netsim.NodeConfig("node")
    config.mobility.telemetry_interval_s = 0
    node = network.add_node(config)
    if protocol is not None:
        node.set_protocol(protocol, lambda failure, method: None)
    network.initialize()
    took_s = 0.0
    for batch in range(count // 1000):
        for number in range(1000):
            node.schedule_timer("x", batch + number * 1e-3)
        begin = process_time()
        network.run_until(batch + 0.9995)
        took_s += process_time() - begin
    network.release_protocols()
    return took_s


def plain_calls(count: int, protocol: Counting) -> float:
    """Return the CPU seconds of `count` calls from Python, loop included."""
    begin = process_time()
    for _ in range(count):
        protocol.handle_timer("x")
    return process_time() - begin


def one_callback(count: int, rounds: int) -> None:
    """Compare one callback through the proxy with a plain call."""
    ratios = []
    for _ in range(rounds):
        plain_s = plain_calls(count, Counting())
        proxied_s = timers(count, Counting()) - timers(count, None)
        ratios.append(proxied_s / plain_s)
        print(f"    plain {plain_s / count * 1e9:.0f} ns, through the proxy {proxied_s / count * 1e9:.0f} ns")
    record("proxy_overhead.ratio", f"{median(ratios):.2f}", "", "bench/python/proxy_overhead.py")
    print(f"one callback through the proxy / a plain call: {median(ratios):.2f} (goal: at most 1.5)")


if __name__ == "__main__":
    one_callback(count=1_000_000, rounds=5)
    whole_run(hours=float(sys.argv[1]) if len(sys.argv) > 1 else 1.0, rounds=5)
