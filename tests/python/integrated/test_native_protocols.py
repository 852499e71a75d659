from pathlib import Path

import pytest

import gradysim.prototype.run
from gradysim.integrated.network import check_scenario
from gradysim.integrated.run import IntegratedRun, run
from gradysim.protocol.errors import NativeProtocolError
from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.schema.native_protocols import native_protocols
from gradysim.scenario.schema.parameters import parameters_of
from gradysim.scenario.schema.protocols import ProtocolLoader
from gradysim.simulator.handler.assertion import AssertionHandler, assert_always_true_for_protocol
from python.integrated.watching import Watching

ROOT = Path(__file__).parents[3]
BEACON = '*.uavs[*].protocol.typename = "BeaconProtocol"'


def kinds_of(cls):
    """Return the default of each parameter, and its type."""
    kinds = {}
    for name, kind in parameters_of(cls).items():
        default = getattr(cls, name)
        written = parse_value("true" if isinstance(default, bool) else "1")
        kinds[name] = (default, type(kind.convert(written)))
    return kinds


@pytest.mark.parametrize(
    "name", [name for name, native in native_protocols().items() if native._python_class]
)
def test_parameters_are_those_of_the_class_in_python(name):
    native = native_protocols()[name]
    python = ProtocolLoader().load(native._python_class, ROOT)
    # Without units, which a Python class cannot declare.
    assert kinds_of(native) == kinds_of(python)


def test_what_it_counted_is_in_the_result(make_scenario):
    spread = "*.uavs[*].protocol.spread = 100ms", "*.uavs[*].protocol.stop = 1.9s"
    result = run(make_scenario("class Tested(Quiet): pass", BEACON, *spread))
    assert [(node.protocol, node.tracked_variables) for node in result.nodes] == [
        ("BeaconProtocol", {"sent": 1, "received": 1}),
        ("BeaconProtocol", {"sent": 1, "received": 1}),
    ]


def test_beside_protocols_in_python(make_scenario):
    result = run(make_scenario("class Tested(Talker): pass", BEACON.replace("[*]", "[0]")))
    assert result.nodes[0].tracked_variables["received"] > 10
    assert result.nodes[1].tracked_variables == {"heard": 2, "finished": True}


def test_a_parameter_out_of_range_is_an_error_at_its_setting(make_scenario):
    scenario = make_scenario("class Tested(Quiet): pass", BEACON, "*.uavs[1].protocol.interval = 0s")
    with pytest.raises(ConfigError) as error:
        check_scenario(scenario)
    assert error.value.key == "*.uavs[1].protocol.interval"


@pytest.mark.parametrize(
    ("line", "place", "told"),
    [
        (
            "*.node.protocol.payload_bytes = 2277",
            "test.ini:4: *.node.protocol.payload_bytes = 2277",
            "0B to 2276B",
        ),
        (
            "*.node.wlan[*].mac.mtu = 127B",
            "test.ini:3: *.node.protocol.typename",
            "0B to 99B",
        ),
    ],
)
def test_a_message_that_the_interface_cannot_send_is_refused_before_the_run(tmp_path, line, place, told):
    path = tmp_path / "test.ini"
    path.write_text(
        f'[General]\nsim-time-limit = 9s\n*.node.protocol.typename = "BeaconProtocol"\n{line}\n'
        "*.node.mobility.initialX = 0m\n"
    )
    (scenario,) = load_scenarios(path)
    with pytest.raises(ConfigError) as error:
        check_scenario(scenario)
    assert place in str(error.value)
    assert told in str(error.value)


def test_prototype_mode_names_the_class_to_use(make_scenario):
    scenario = make_scenario("class Tested(Quiet): pass", BEACON)
    with pytest.raises(ConfigError, match=r"examples/reference/beacon\.py:Beacon") as error:
        gradysim.prototype.run.run(scenario)
    assert error.value.key == "*.uavs[*].protocol.typename"


@pytest.mark.parametrize(
    ("lines", "key", "text"),
    [
        (
            ['*.uavs[*].protocol.typename = "SaturatingSource"', "*.uavs[*].protocol.destination = 77"],
            "*.uavs[*].protocol.destination",
            " 0 to 1",
        ),
        (
            ['*.uavs[*].protocol.typename = "SaturatingSource"'],
            "*.uavs[*].protocol.typename",
            " uavs[0] itself, ",
        ),
        (
            ['*.uavs[*].protocol.typename = "FloodProtocol"', "*.uavs[*].protocol.origin = 2"],
            "*.uavs[*].protocol.origin",
            " 0 to 1",
        ),
        (
            [
                '*.uavs[1].protocol.typename = "ZigZagMobileProtocol"',
                '*.uavs[*].mobility.typename = "StationaryMobility"',
            ],
            "*.uavs[*].mobility.typename",
            '"MasslessMobility" for uavs[1]',
        ),
    ],
)
def test_what_only_the_whole_network_shows_to_be_wrong_is_refused_before_the_run(
    make_scenario, lines, key, text
):
    scenario = make_scenario("class Tested(Quiet): pass", *lines)
    with pytest.raises(ConfigError) as error:
        check_scenario(scenario)
    assert error.value.key == key
    assert text in str(error.value)


def test_what_it_gets_wrong_in_the_run_ends_it_with_a_note_of_the_place(make_scenario):
    flood = '*.uavs[1].protocol.typename = "FloodProtocol"'
    built = IntegratedRun(make_scenario("class Tested(Talker): pass", flood))
    with pytest.raises(NativeProtocolError, match=r"FloodProtocol") as error:
        built.execute()
    (note,) = error.value.__notes__
    assert "(FloodProtocol 1) at 0.1" in note
    assert built.result().interrupted


def test_handlers_see_the_node_and_its_parameters(make_scenario):
    seen = []

    @assert_always_true_for_protocol(native_protocols()["BeaconProtocol"], name="seen")
    def look(node):
        seen.append((node.id, node.protocol_encapsulator.protocol.interval))
        return True

    interval = "*.uavs[*].protocol.interval = 0.5s"
    scenario = make_scenario("class Tested(Quiet): pass", BEACON, interval)
    run(scenario, handlers=[AssertionHandler([look])])
    assert set(seen) == {(0, 0.5), (1, 0.5)}


def test_handlers_can_ask_for_the_id_and_the_time_of_its_node(make_scenario):
    class Asking(Watching):
        def finalize(self):
            providers = [node.protocol_encapsulator.protocol.provider for node in self.nodes]
            self.told = [(provider.get_id(), provider.current_time()) for provider in providers]

    handler = Asking()
    run(make_scenario("class Tested(Quiet): pass", BEACON), handlers=[handler])
    assert handler.told == [(0, 2.05), (1, 2.05)]
