"""Native protocols behave exactly like their counterparts in Python: runs have equal result hashes.

The hash covers the frames on the air, their outcomes, the packets and timers of all protocols with their
content, and what the protocols tracked.
"""

from functools import cache
from pathlib import Path

import pytest

from gradysim.integrated.native_protocols import is_native
from gradysim.integrated.run import run
from gradysim.results.result import RunResult
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.schema.native_protocols import native_protocols

ROOT = Path(__file__).parents[3]
ZIGZAG = "configs/zigzag.ini"
BEACONS = "configs/reference/beacons.ini"
SATURATION = "configs/reference/saturation.ini"
FLOOD = "configs/reference/flood.ini"

STATIONS = '*.stations[*].protocol.typename = "SaturatingSource"'
SINK = '*.sink.protocol.typename = "SinkProtocol"'
COUNT_FROM = "*.sink.protocol.count_from = 1s"
SPREAD = "*.stations[*].protocol.spread = 500ms"
NO_JITTER = "**.protocol.heartbeat_jitter = 0s"


def seconds(limit: int) -> str:
    return f"sim-time-limit = {limit}s"


PAIRS = {
    "beacons": ((BEACONS, "Beacons100", seconds(5)), (BEACONS, "Python100", seconds(5))),
    "source and sink": (
        (SATURATION, "G54", seconds(2), COUNT_FROM, STATIONS, SINK),
        (SATURATION, "G54", seconds(2), COUNT_FROM),
    ),
    "sources that begin at times of their own": (
        (SATURATION, "G54", seconds(2), SPREAD, STATIONS, SINK),
        (SATURATION, "G54", seconds(2), SPREAD),
    ),
    "flood": ((FLOOD, "General"), (FLOOD, "Python")),
    "ZigZag of 5": ((ZIGZAG, "ZigZag5Native", seconds(900)), (ZIGZAG, "ZigZag5", seconds(900))),
    "ZigZag of 15": ((ZIGZAG, "ZigZag15Native", seconds(900)), (ZIGZAG, "ZigZag15", seconds(900))),
    "ZigZag of 5, synchronised": (
        (ZIGZAG, "ZigZag5Native", seconds(900), NO_JITTER),
        (ZIGZAG, "ZigZag5Synchronised", seconds(900)),
    ),
    "ZigZag of 15, synchronised": (
        (ZIGZAG, "ZigZag15Native", seconds(900), NO_JITTER),
        (ZIGZAG, "ZigZag15Synchronised", seconds(900)),
    ),
}
"""File, configuration and overrides of a run of native protocols, and of the same run in Python."""


def scenario(file: str, config: str, *overrides: str, seed: int = 1) -> Scenario:
    (loaded,) = load_scenarios(ROOT / file, config, runs=[0], overrides=[f"seed-set = {seed}", *overrides])
    return loaded


@cache
def result(file: str, config: str, *overrides: str, seed: int = 1) -> RunResult:
    return run(scenario(file, config, *overrides, seed=seed))


def what_happened(result: RunResult) -> tuple[object, ...]:
    """Return the result without names of protocols and run times."""
    return (
        result.result_hash,
        result.events,
        result.outcomes,
        [(node.position, node.tracked_variables) for node in result.nodes],
    )


def assert_alike(native: RunResult, python: RunResult) -> None:
    assert [node.protocol for node in native.nodes] != [node.protocol for node in python.nodes]
    assert what_happened(native) == what_happened(python)


def test_every_native_protocol_that_has_a_counterpart_is_compared() -> None:
    compared = {
        spec.protocol.__name__
        for native, _ in PAIRS.values()
        for spec in scenario(*native).nodes
        if is_native(spec)
    }
    assert compared == {name for name, native in native_protocols().items() if native._python_class}


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("pair", PAIRS)
def test_both_do_the_same(pair: str, seed: int) -> None:
    native, python = PAIRS[pair]
    assert_alike(result(*native, seed=seed), result(*python, seed=seed))


@pytest.mark.parametrize("size", [5, 15])
def test_in_zigzag_they_meet(size: int) -> None:
    native, _ = PAIRS[f"ZigZag of {size}"]
    assert any(node.tracked_variables.get("interactions") for node in result(*native).nodes)


def test_the_flood_reaches_the_last_node_by_many_hops() -> None:
    native, _ = PAIRS["flood"]
    last = result(*native).nodes[-1].tracked_variables
    assert last["received"] == 9
    assert last["most_hops"] >= 15, "a hop leads over two nodes at most"


def test_half_of_the_nodes_native() -> None:
    half = '*.uavs[0..3].protocol.typename = "ZigZagMobileProtocol"'
    mixed = result(ZIGZAG, "ZigZag15", seconds(600), half)
    assert_alike(mixed, result(ZIGZAG, "ZigZag15", seconds(600)))


def test_another_seed_is_another_run() -> None:
    native, _ = PAIRS["ZigZag of 5"]
    assert result(*native, seed=0).fingerprint != result(*native, seed=1).fingerprint
