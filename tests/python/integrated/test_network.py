from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.integrated.network import (
    build_network,
    by_kind,
    check_scenario,
    medium_config,
    node_config,
    one_of_each_kind,
    set_fields,
)
from gradysim.scenario import Scenario
from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.schema.values import Setting


def setting(value, key="key"):
    return Setting(value, Source(Path("a.ini"), 7, key))


def test_a_node_per_spec_in_the_order_of_ids(make_scenario):
    network, nodes = build_network(make_scenario())
    assert [(node.id, node.name, node.position) for node in nodes] == [
        (0, "uavs[0]", (0.0, 0.0, 0.0)),
        (1, "uavs[1]", (10.0, 0.0, 0.0)),
    ]
    assert network.now == 0.0


def test_settings_reach_their_structs(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet): pass",
        "*.uavs[*].wlan[*].radio.transmitter.power = 2mW",
        '*.uavs[*].wlan[*].opMode = "b"',
        "*.uavs[*].mobility.speed = 3mps",
        '*.uavs[*].wlan[*].radio.antenna.typename = "ConstantGainAntenna"',
        "*.uavs[*].wlan[*].radio.antenna.gain = 10dB",
    )
    config = node_config(scenario.nodes[1])
    radio, mac = config.wlan[0].radio, config.wlan[0].mac
    assert (radio.tx_power_w, mac.op_mode, config.mobility.speed_mps) == (0.002, "b", 3.0)
    assert (radio.antenna.typename, radio.antenna.gain) == ("ConstantGainAntenna", 10.0)


def test_settings_of_802154_reach_its_mac(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet): pass",
        '*.uavs[*].wlan[*].typename = "Ieee802154NarrowbandInterface"',
        "*.uavs[*].wlan[*].mac.macMaxFrameRetries = 5",
    )
    interface = node_config(scenario.nodes[0]).wlan[0]
    assert (interface.typename, interface.csma.max_frame_retries) == ("Ieee802154NarrowbandInterface", 5)


def test_settings_of_the_medium(make_scenario):
    scenario = make_scenario("class Tested(Quiet): pass", "*.radioMedium.pathLoss.alpha = 3")
    assert medium_config(scenario).alpha == 3.0


def test_thermal_noise(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet): pass",
        '*.radioMedium.backgroundNoise.typename = "ThermalNoise"',
        "*.radioMedium.backgroundNoise.temperature = 300K",
    )
    config = medium_config(scenario)
    assert (config.background_noise, config.temperature_k) == ("ThermalNoise", 300.0)


def test_noise_of_a_receiver_that_would_keep_its_channel_busy_is_an_error_there(make_scenario):
    scenario = make_scenario(
        "class Tested(Quiet): pass",
        '*.radioMedium.backgroundNoise.typename = "ThermalNoise"',
        "*.uavs[1].wlan[*].radio.receiver.energyDetection = -95dBm",
    )
    with pytest.raises(ConfigError) as error:
        check_scenario(scenario)
    assert error.value.key == "*.uavs[1].wlan[*].radio.receiver.energyDetection"


def with_error_table(make_scenario, value):
    """Return a scenario whose radios have that table of error rates, as in a file."""
    return make_scenario(
        "class Tested(Quiet): pass",
        '**.errorModel.typename = "Ieee80211BerTableErrorModel"',
        f"**.errorModel.berTableFile = {value}",
    )


def test_a_malformed_table_of_error_rates_is_refused_where_it_is_named(make_scenario, tmp_path):
    table = tmp_path / "table.csv"
    table.write_text("bitrate_mbps,psdu_bytes,snir_db,success\n24,100,ten,0.5\n")
    scenario = with_error_table(make_scenario, f'"{table}"')
    with pytest.raises(ConfigError, match=r'berTableFile: line 2: "ten": ') as error:
        check_scenario(scenario)
    assert error.value.key == "**.errorModel.berTableFile"


@pytest.mark.parametrize("value", ['"tabel.csv"', "tabel.csv", '${"tabel.csv"}'])
def test_a_missing_error_table_is_told_with_the_one_that_may_be_meant(make_scenario, tmp_path, value):
    (tmp_path / "table.csv").touch()
    scenario = with_error_table(make_scenario, value)
    with pytest.raises(ConfigError, match=r" `table\.csv`\?$"):
        check_scenario(scenario)


def test_a_missing_error_table_is_told_with_its_folder(make_scenario, tmp_path):
    (tmp_path / "tables").mkdir()
    (tmp_path / "tables" / "table.csv").touch()
    scenario = with_error_table(make_scenario, "tables/tabel.csv")
    with pytest.raises(ConfigError, match=r" `tables/table\.csv`\?$"):
        check_scenario(scenario)


def test_an_error_table_that_no_file_can_be_called_is_refused_where_it_is_named(make_scenario):
    scenario = with_error_table(make_scenario, f'"{"a" * 300}.csv"')
    with pytest.raises(ConfigError) as error:
        check_scenario(scenario)
    assert error.value.key == "**.errorModel.berTableFile"


@pytest.mark.parametrize(
    "text",
    [
        "*.uavs[*].wlan[*].mac.dcf.channelAccess.cwMin = 2000",
        "*.uavs[*].wlan[*].bitrate = 7Mbps",
    ],
)
def test_what_the_engine_refuses_is_an_error_at_its_setting(make_scenario, text):
    scenario = make_scenario("class Tested(Quiet): pass", text)
    with pytest.raises(ConfigError) as error:
        check_scenario(scenario)
    assert error.value.key == text.partition(" = ")[0]


def test_a_value_of_a_type_that_the_field_cannot_hold_is_an_error_at_its_setting():
    class Strict:
        @property
        def field(self):
            return 0

        @field.setter
        def field(self, value):
            raise TypeError

    with pytest.raises(ConfigError, match=r"a\.ini:7: .*'x' "):
        set_fields(Strict(), {"field": setting("x")})


FOUR = "*.numUavs = 4"


@pytest.mark.parametrize(
    ("settings", "kinds"),
    [
        ([], [[0, 1, 2, 3]]),
        (["*.uavs[1].wlan[*].radio.channelNumber = 5"], [[0, 2, 3], [1]]),
        (["*.uavs[2..].mobility.speed = 3mps"], [[0, 1], [2, 3]]),
        (["*.uavs[*].mobility.initialX = uniform(0m, 1km)"], [[0, 1, 2, 3]]),
    ],
    ids=["all", "an interface", "mobility", "places"],
)
def test_nodes_are_alike_if_the_same_lines_hold_for_them(
    make_scenario: Callable[..., Scenario], settings: list[str], kinds: list[list[int]]
) -> None:
    scenario = make_scenario("class Tested(Quiet): pass", FOUR, *settings)
    assert [[spec.id for spec in specs] for specs in by_kind(scenario.nodes).values()] == kinds
    assert [spec.id for spec in one_of_each_kind(scenario.nodes)] == [ids[0] for ids in kinds]


def test_nodes_of_two_groups_are_of_two_kinds(make_scenario: Callable[..., Scenario]) -> None:
    boats = ("*.boats.count = 2", '*.boats[*].protocol.class = "protocol.py:Tested"')
    scenario = make_scenario("class Tested(Quiet): pass", *boats)
    assert sorted(len(specs) for specs in by_kind(scenario.nodes).values()) == [2, 2]
