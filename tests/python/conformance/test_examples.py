"""The protocols of examples/ behave alike in both modes on a perfect channel; ZigZag has its own file.

The scenarios are those of configs/reference and a few more, shortened. If nodes are at a distance, the range
excludes some receivers.
"""

import ast
from pathlib import Path

import pytest
from watched_run import Trace, assert_same, trace_scenario

from gradysim.scenario import Scenario, load_scenarios
from python.thorough import some

ROOT = Path(__file__).parents[3]
CONFIGS = ROOT / "configs"
LIMIT_S = 2.5

CASES = {  # file in configs, up to a comma: (configuration, reach in meters, more settings)
    "reference/beacons": ("Python100", 300, ()),
    "reference/capture": ("General", 100, ()),
    "reference/flood": ("Python", 50, ()),
    "reference/flyby": ("FlybySensitivity", 100, ()),
    "reference/hidden": ("General", 1000, ()),
    "reference/hidden_inet": ("Hidden24", 300, ("sim-time-limit = 150ms",)),
    "reference/jittered": ("General", 100, ()),
    "reference/link": ("Snr24", 45, ()),
    "reference/narrowband": ("Contention", 100, ()),
    "reference/narrowband_contention": (
        "Inet",
        100,
        (
            "sim-time-limit = 200ms",
            "*.sink.protocol.count_from = 10ms",
            '*.sink.protocol.class = "../../examples/reference/sink.py:Sink"',
            '*.stations[*].protocol.class = "../../examples/reference/saturating_source.py:SaturatingSource"',
        ),
    ),
    "reference/narrowband_link": (
        "General",
        150,
        (
            '*.sender.protocol.class = "../../examples/reference/beacon.py:Beacon"',
            '*.receivers[*].protocol.class = "../../examples/reference/sink.py:Sink"',
        ),
    ),
    "reference/ns3_networks": (
        "Hidden3",
        120,
        ("sim-time-limit = 50ms", "**.protocol.count_from = 10ms"),
    ),
    "reference/rate_control": ("Fixed", 1000, ("sim-time-limit = 50ms", "*.sink.protocol.count_from = 10ms")),
    "reference/rate_control_inet": ("ArfTimer", 1000, ()),
    "reference/saturation": ("G54", 100, ("sim-time-limit = 50ms", "*.sink.protocol.count_from = 10ms")),
    "reference/sir": ("General", 1000, ()),
    "reference/synchronised": ("General", 100, ()),
    "reference/unicast_failures": ("Bursts", 300, ()),
    "collision_avoidance": ("General", 1000, ()),
    "coverage": ("General", 1000, ("*.drones[*].protocol.start = 1s",)),
    "data_mule": ("General", 200, ()),
    "hidden_terminals": ("General", 1000, ()),
    "leader_election": ("General", 1000, ()),
    "leader_election, again": ("Raft", 1000, ()),
    "relay_chain": ("General", 120, ()),
    "search": ("General", 1000, ()),
    "scouts": ("General", 1000, ()),
    "sensor_field": ("Spread", 20, ("sim-time-limit = 20s",)),
    "sensor_field, again": ("Gateway", 150, ("sim-time-limit = 20s",)),
}


def scenario_of(name: str) -> Scenario:
    file = CONFIGS / f"{name.partition(',')[0]}.ini"
    config, reach_m, settings = CASES[name]
    scenarios = load_scenarios(
        file,
        config,
        overrides=[
            *settings,
            f"sim-time-limit = {LIMIT_S}s",
            '*.radioMedium.typename = "UnitDiskRadioMedium"',
            f"**.wlan[*].radio.transmitter.communicationRange = {reach_m}m",
            f"*.communicationMedium.transmissionRange = {reach_m}m",
        ],
    )
    return scenarios[0]


def both(name: str) -> Trace:
    """Check that both modes agree; return the trace."""
    integrated, prototype = (trace_scenario(mode, scenario_of(name)) for mode in ("integrated", "prototype"))
    assert_same(integrated, prototype)
    return integrated


@pytest.mark.parametrize("name", some(CASES, 5))
def test_a_reference_scenario(name: str) -> None:
    names = both(name).names()
    assert names.count("send_communication_command") > 1
    assert names.count("handle_packet") > 1


def test_every_reference_scenario_is_among_them() -> None:
    files = [
        file
        for file in (CONFIGS / "reference").glob("*.ini")
        if "sim-time-limit" in file.read_text()  # other files are only included
    ]
    assert {f"reference/{file.stem}" for file in files} <= CASES.keys()


def test_every_protocol_of_the_examples_is_in_one_of_the_scenarios() -> None:
    scenarios = [scenario_of(name) for name in CASES]
    scenarios += load_scenarios(CONFIGS / "zigzag.ini", "ZigZag5")
    used = {node.protocol.__name__ for scenario in scenarios for node in scenario.nodes}
    classes = [
        node
        for file in (ROOT / "examples").rglob("*.py")
        for node in ast.walk(ast.parse(file.read_text()))
        if isinstance(node, ast.ClassDef)
    ]
    protocols = {
        node.name
        for node in classes
        if any(isinstance(base, ast.Name) and base.id == "IProtocol" for base in node.bases)
    }
    assert protocols
    assert protocols <= used
