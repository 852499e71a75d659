"""A native protocol does what its counterpart in Python does, to the last bit: runs have equal fingerprints.

The fingerprint holds the frames on the air, what became of them, and the packets and timers of all protocols
with their texts.
"""

from functools import cache
from pathlib import Path

import pytest

from gradysim.config.scenario import load_scenarios
from gradysim.integrated.run import run
from gradysim.results.run_result import RunResult

ROOT = Path(__file__).parents[3]
ZIGZAG = "configs/zigzag.ini"
BEACONS = "configs/reference/beacons.ini"
SATURATION = "configs/reference/saturation.ini"

FLOOD = "configs/reference/flood.ini"
STATIONS = '*.stations[*].protocol.typename = "SaturatingSource"'
SINK = '*.sink.protocol.typename = "SinkProtocol"'
SECOND = "sim-time-limit = 2s"


@cache
def result(file: str, config: str, *overrides: str, seed: int = 1) -> RunResult:
    (scenario,) = load_scenarios(ROOT / file, config, runs=[0], overrides=[f"seed-set = {seed}", *overrides])
    return run(scenario)


def what_happened(result: RunResult) -> tuple[object, ...]:
    """All but the names of protocols and the time that it took."""
    return (
        result.fingerprint,
        result.events,
        result.fates,
        [(node.position, node.tracked_variables) for node in result.nodes],
    )


def assert_alike(native: RunResult, python: RunResult) -> None:
    assert [node.protocol for node in native.nodes] != [node.protocol for node in python.nodes]
    assert what_happened(native) == what_happened(python)


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("variant", ["", "Synchronised"])
@pytest.mark.parametrize("size", ["ZigZag5", "ZigZag15"])
def test_zigzag(size: str, variant: str, seed: int) -> None:
    limit = "sim-time-limit = 900s"
    jitter = ["**.protocol.heartbeat_jitter = 0s"] if variant else []
    native = result(ZIGZAG, f"{size}Native", limit, *jitter, seed=seed)
    assert_alike(native, result(ZIGZAG, f"{size}{variant}", limit, seed=seed))
    if not variant:
        assert any(node.tracked_variables.get("interactions") for node in native.nodes)


def test_half_of_the_nodes_native() -> None:
    limit = "sim-time-limit = 600s"
    mixed = result(ZIGZAG, "ZigZag15", limit, '*.uavs[0..3].protocol.typename = "ZigZagMobileProtocol"')
    assert_alike(mixed, result(ZIGZAG, "ZigZag15", limit))


def test_beacons() -> None:
    native = result(BEACONS, "Beacons100", "sim-time-limit = 5s")
    assert_alike(native, result(BEACONS, "Python100", "sim-time-limit = 5s"))


def test_source_and_sink() -> None:
    count_from = "*.sink.protocol.count_from = 1s"
    native = result(SATURATION, "G54", SECOND, count_from, STATIONS, SINK)
    assert_alike(native, result(SATURATION, "G54", SECOND, count_from))


def test_sources_that_begin_at_times_of_their_own() -> None:
    spread = "*.stations[*].protocol.spread = 500ms"
    native = result(SATURATION, "G54", SECOND, spread, STATIONS, SINK)
    assert_alike(native, result(SATURATION, "G54", SECOND, spread))


def test_flood() -> None:
    native = result(FLOOD, "General")
    assert_alike(native, result(FLOOD, "Python"))
    last = native.nodes[-1].tracked_variables
    assert last["received"] == 9
    assert last["most_hops"] >= 15, "a hop leads over two nodes at most"


def test_another_seed_is_another_run() -> None:
    limit = "sim-time-limit = 100s"
    assert result(ZIGZAG, "ZigZag5Native", limit, seed=0).fingerprint != (
        result(ZIGZAG, "ZigZag5Native", limit, seed=1).fingerprint
    )
