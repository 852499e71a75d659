from math import pi
from typing import Any

import pytest

from gradysim.scenario.node_spec import InterfaceSpec
from gradysim.scenario.scenario import Scenario

LINE = """\
*.uavs[*].mobility.lineStartX = 100m
*.uavs[*].mobility.lineStepX = 50m
*.uavs[*].mobility.lineStepZ = 1m
"""


def positions(scenario: Scenario) -> list[tuple[float, float, float]]:
    return [node.initial_position for node in scenario.nodes if node.group == "uavs"]


def values(mapping: Any) -> dict[str, object]:
    return {field: setting.value for field, setting in mapping.items()}


def test_nodes_have_ids_names_groups_and_indices(folder: Any) -> None:
    assert [
        (node.id, node.name, node.group, node.index, node.protocol.__name__) for node in folder.load().nodes
    ] == [
        (0, "groundStation", "groundStation", 0, "Sensor"),
        (1, "uavs[0]", "uavs", 0, "Mobile"),
        (2, "uavs[1]", "uavs", 1, "Mobile"),
    ]


def test_nodes_start_at_the_origin(folder: Any) -> None:
    assert positions(folder.load()) == [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)]


def test_nodes_start_along_a_line(folder: Any) -> None:
    assert positions(folder.load(LINE)) == [(100.0, 0.0, 0.0), (150.0, 0.0, 1.0)]


def test_nodes_start_at_places_of_their_own(folder: Any) -> None:
    added = "*.uavs[1].mobility.initialX = 7m\n*.uavs[*].mobility.initialY = 2m\n" + LINE
    assert positions(folder.load(added)) == [(100.0, 2.0, 0.0), (7.0, 2.0, 1.0)]


def test_of_line_and_place_the_first_in_search_order_counts(folder: Any) -> None:
    added = LINE + "*.uavs[1].mobility.initialX = 7m\n[X]\n*.uavs[1].mobility.initialX = 7m\n"
    assert positions(folder.load(added))[1][0] == 150.0
    assert positions(folder.load(added, "X"))[1][0] == 7.0


def test_only_what_was_written_is_set(folder: Any) -> None:
    node = folder.load().nodes[0]
    assert (node.mobility, node.wlan, node.protocol_parameters) == ({}, (InterfaceSpec(),), {})


@pytest.mark.parametrize(
    ("key", "text", "struct", "field", "value"),
    [
        (
            "mobility.typename",
            '"StationaryMobility"',
            "mobility",
            "typename",
            "StationaryMobility",
        ),
        ("mobility.speed", "36kmph", "mobility", "speed_mps", 10.0),
        ("mobility.telemetryInterval", "0s", "mobility", "telemetry_interval_s", 0.0),
        ("wlan[*].opMode", '"g(erp)"', "mac", "op_mode", "g(erp)"),
        ("wlan[*].bitrate", "5.5Mbps", "mac", "bitrate_bps", 5.5e6),
        ("wlan[*].mac.mtu", "1500B", "mac", "mtu_bytes", 1500),
        ("**.multicastFrameBitrate", "-1bps", "mac", "multicast_bitrate_bps", -1.0),
        ("**.controlFrameBitrate", "6Mbps", "mac", "control_bitrate_bps", 6e6),
        ("**.rtsThreshold", "500B", "mac", "rts_threshold_bytes", 500),
        ("**.ownFramesSetNav", "false", "mac", "own_frames_set_nav", False),
        ("**.contention.inetEifs", "true", "mac", "inet_eifs", True),
        ("**.shortRetryLimit", "4", "mac", "short_retry_limit", 4),
        ("**.inetStationRetryCounters", "true", "mac", "inet_station_retry_counters", True),
        ("**.cwMin", "15", "mac", "cw_min", 15),
        ("**.cwMax", "63", "mac", "cw_max", 63),
        ("**.packetCapacity", "10", "mac", "queue_capacity", 10),
        ("**.backoffOptimization", "false", "mac", "backoff_optimization", False),
        ("**.initialChannelBusy", "false", "mac", "initial_channel_busy", False),
        ("**.skipBackoffIfIdle", "true", "mac", "skip_backoff_if_idle", True),
        ("wlan[*].radio.channelNumber", "5", "radio", "carrier_hz", 2.437e9),
        ("wlan[*].radio.bandName", '"5.9 GHz"', "radio", "carrier_hz", 5.86e9),
        ("wlan[*].radio.centerFrequency", "5.18GHz", "radio", "carrier_hz", 5.18e9),
        ("wlan[*].radio.bandwidth", "20MHz", "radio", "bandwidth_hz", 20e6),
        ("wlan[*].radio.transmitter.power", "0.95mW", "radio", "tx_power_w", 0.00095),
        (
            "wlan[*].radio.transmitter.communicationRange",
            "1km",
            "radio",
            "communication_range_m",
            1000.0,
        ),
        (
            "wlan[*].radio.receiver.sensitivity",
            "-90dBm",
            "radio",
            "sensitivity_w",
            1e-12,
        ),
        (
            "wlan[*].radio.receiver.energyDetection",
            "1pW",
            "radio",
            "energy_detection_w",
            1e-12,
        ),
        (
            "wlan[*].radio.receiver.snirThreshold",
            "10dB",
            "radio",
            "snir_threshold",
            10.0,
        ),
        (
            "**.errorModel.typename",
            '"Ieee80211NistErrorModel"',
            "radio",
            "error_model",
            "Ieee80211NistErrorModel",
        ),
        ("**.errorModel.snirMode", '"chunks"', "radio", "snir_mode", "chunks"),
        ("**.receiver.noiseFigure", "10dB", "radio", "noise_figure", 10.0),
        ("**.preambleDetection.threshold", "10dB", "radio", "preamble_threshold", 10.0),
        ("**.preambleDetection.minimumPower", "-90dBm", "radio", "preamble_minimum_power_w", 1e-12),
        ("**.preambleDetection.duration", "8us", "radio", "preamble_duration_s", 8e-6),
        ("**.frameCapture.margin", "10dB", "radio", "capture_margin", 10.0),
        ("**.frameCapture.window", "8us", "radio", "capture_window_s", 8e-6),
        (
            "**.antenna.typename",
            '"DipoleAntenna"',
            "antenna",
            "typename",
            "DipoleAntenna",
        ),
        ("wlan[*].radio.antenna.maxGain", "10dB", "antenna", "max_gain", 10.0),
        ("wlan[0].radio.antenna.beamWidth", "90deg", "antenna", "beam_width_rad", pi / 2),
        ("wlan[*].radio.antenna.offsetElevation", "-90deg", "antenna", "offset_elevation_rad", -pi / 2),
        ("mobility.initialHeading", "180deg", "mobility", "initial_heading_rad", pi),
        ("mobility.faceForward", "true", "mobility", "face_forward", True),
    ],
)
def test_keys_reach_their_fields(
    folder: Any, key: str, text: str, struct: str, field: str, value: object
) -> None:
    node = folder.load(f"*.uavs[*].{key} = {text}\n").nodes[1]
    setting = (node.mobility if struct == "mobility" else node.wlan[0].structs()[struct])[field]
    assert (
        setting.value == pytest.approx(value, rel=1e-14)
        if isinstance(value, float)
        else setting.value == value
    )
    assert type(setting.value) is type(value)
    assert (setting.source.line, setting.source.key) == (6, f"*.uavs[*].{key}")


def test_each_node_has_the_first_entry_that_matches_it(folder: Any) -> None:
    scenario = folder.load(
        "*.uavs[1].mobility.speed = 1mps\n**.speed = 2mps\n*.uavs[0].mobility.speed = 3mps\n"
    )
    assert [node.mobility["speed_mps"].value for node in scenario.nodes] == [
        2.0,
        2.0,
        1.0,
    ]


def test_default_stops_the_search(folder: Any) -> None:
    scenario = folder.load(
        "*.uavs[1].mobility.speed = default\n*.uavs[1].protocol.retries = default\n"
        "*.uavs[*].mobility.speed = 2mps\n*.uavs[*].protocol.retries = 2\n"
    )
    assert [values(node.mobility) for node in scenario.nodes] == [
        {},
        {"speed_mps": 2.0},
        {},
    ]
    assert [node.protocol_parameters for node in scenario.nodes] == [
        {},
        {"retries": 2},
        {},
    ]


def test_protocol_parameters_are_converted(folder: Any) -> None:
    scenario = folder.load(
        "*.uavs[*].protocol.heartbeat_jitter = 100ms\n*.uavs[0].protocol.retries = 5\n"
        '**.label = "x"\n**.eager = true\n**.launch_interval = 2\n'
    )
    expected = {
        "heartbeat_jitter": 0.1,
        "label": "x",
        "eager": True,
        "launch_interval": 2.0,
    }
    assert [node.protocol_parameters for node in scenario.nodes] == [
        {},
        {**expected, "retries": 5},
        expected,
    ]


def test_nodes_of_one_group_may_run_different_protocols(folder: Any) -> None:
    scenario = folder.load('[X]\n*.uavs[0].protocol.class = "protocols.py:Sensor"\n**.retries = 1\n', "X")
    assert [node.protocol.__name__ for node in scenario.nodes] == [
        "Sensor",
        "Sensor",
        "Mobile",
    ]
    assert [node.protocol_parameters for node in scenario.nodes] == [
        {},
        {},
        {"retries": 1},
    ]


def test_nodes_of_one_file_share_its_classes(folder: Any) -> None:
    nodes = folder.load().nodes
    assert nodes[1].protocol is nodes[2].protocol
    assert issubclass(nodes[1].protocol, nodes[0].protocol)


def test_a_file_is_relative_to_the_file_that_holds_the_line(folder: Any) -> None:
    folder.write(
        "sub/protocols.py",
        (folder.path / "protocols.py").read_text() + "\n\nclass Sub(Sensor): pass\n",
    )
    folder.write("sub/more.ini", '*.boat.protocol.class = "protocols.py:Sub"\n')
    assert [node.protocol.__name__ for node in folder.load("include sub/more.ini\n").nodes][-1] == "Sub"


@pytest.mark.parametrize(
    ("added", "message"),
    [
        (
            "*.uavs[*].mobility.speed = 3\n",
            "*.uavs[*].mobility.speed = 3: `3` has no unit; expected a speed such as 10mps, at least 0mps",
        ),
        (
            "*.uavs[*].mobility.speed = 3m\n",
            "*.uavs[*].mobility.speed = 3m: `m` is the unit of a length; "
            "expected a speed such as 10mps, at least 0mps",
        ),
        (
            "**.speed = -3mps\n",
            "**.speed = -3mps: for groundStation.mobility.speed: it is out of range; expected a speed such as"
            " 10mps, at least 0mps",
        ),
        (
            "**.power = nan W\n",
            "**.power = nan W: for groundStation.wlan[0].radio.transmitter.power: `nanW` is not finite;"
            " expected a power such as 20mW or -85dBm, at least 0W and at most 1e+12W",
        ),
        (
            "**.power = 2W\n",
            "**.power = 2W: for radioMedium.backgroundNoise.power: `2W` is more than any radio receives;"
            " expected a power such as 20mW or -85dBm, at least 0W and at most 1W; is a minus sign missing?",
        ),
        (
            '**.opMode = "g"\n',
            '**.opMode = "g": for groundStation.wlan[0].opMode: `g` is not known; expected one of "b",'
            ' "g(erp)", "g(mixed)", "a"',
        ),
        (
            "**.retries = 1.5\n",
            "**.retries = 1.5: for uavs[0].protocol.retries: `1.5` is not an integer; expected an"
            " integer, as the parameter is an int; for other numbers write `retries: float = 3` in the class",
        ),
        (
            "**.launch_interval = -15deg\n",
            "**.launch_interval = -15deg: for uavs[0].protocol.launch_interval: `deg` at `launch_interval`,"
            " which does not say what unit the protocol gets; expected a plain number, or an attribute named"
            " `launch_interval_deg` or `launch_interval_rad`",
        ),
        (
            "*.boat.protocol.class = 3\n",
            '*.boat.protocol.class = 3: it is a number; expected a text in quotes ("...")',
        ),
        (
            '*.boat.protocol.class = "protocol.py:Mobile"\n',
            '*.boat.protocol.class = "protocol.py:Mobile": there is no file protocol.py; '
            'expected a protocol as "file.py:Class" or "package.module:Class"; did you mean `protocols.py`?',
        ),
        (
            "*.numBoats = 1\n",
            "nothing says which protocol boats[0] runs; "
            'expected `*.boats[*].protocol.class = "file.py:Class"`',
        ),
    ],
)
def test_errors(folder: Any, added: str, message: str) -> None:
    assert folder.error(added) == f"test.ini:6: {message}"


def test_a_single_node_has_no_index_to_be_told_of(folder: Any) -> None:
    added = '*.boat.protocol.class = default\n*.boat.protocol.class = "protocols.py:Mobile"\n'
    assert folder.mistake(added).expected == '`*.boat.protocol.class = "file.py:Class"`'


@pytest.mark.parametrize("rest", ["protocl.class", "protocol.clas", "protocol.Class", "protocol"])
def test_a_line_that_was_meant_to_say_the_protocol_is_named(folder: Any, rest: str) -> None:
    error = folder.mistake(f'*.numBoats = 1\n*.boats[*].{rest} = "protocols.py:Mobile"\n')
    assert (error.line, error.expected) == (7, "`*.boats[*].protocol.class`")
    assert error.problem.startswith(f"`*.boats[*].{rest}` ")


@pytest.mark.parametrize(
    ("key", "meant"),
    [
        ("*.boats.protocol.class", "class"),
        ("**.boats.protocol.class", "class"),
        ("*.b*s.protocol.class", "class"),
        ("*.boats.protocol.typename", "typename"),
        ("*.boats.protocol.clas", "class"),
    ],
)
def test_a_line_that_lacks_the_index_is_named(folder: Any, key: str, meant: str) -> None:
    error = folder.mistake(f'*.numBoats = 1\n{key} = "protocols.py:Mobile"\n')
    assert (error.line, error.expected) == (7, f"`*.boats[*].protocol.{meant}`")
    assert error.problem.startswith(f"`{key}` ")


def test_a_line_without_index_that_says_nothing_is_not_blamed(folder: Any) -> None:
    error = folder.mistake("*.numBoats = 1\n*.boats.protocol.class = default\n")
    assert error.line == 6
    assert "*.boats.protocol.class" not in error.problem


def test_a_single_node_whose_class_is_misspelt_is_no_node(folder: Any) -> None:
    error = folder.mistake('*.boat.protocol.clas = "protocols.py:Mobile"\n')
    assert (error.line, error.suggestion) == (6, "*.boat.protocol.class")


def test_ten_thousand_nodes_share_what_is_the_same(folder: Any) -> None:
    scenario = folder.load("*.uavs[3].mobility.speed = 3mps\n**.power = 1mW\n[X]\n*.numUavs = 10000\n", "X")
    assert len(scenario.nodes) == 10001
    assert len({id(node.mobility) for node in scenario.nodes if node.group == "uavs"}) == 2
    assert len({id(node.wlan[0]) for node in scenario.nodes if node.group == "uavs"}) == 1


def test_a_thousand_keys_of_any_kind_take_no_time(folder: Any) -> None:
    keys = "".join(f"**.uavs[{index}].mobility.initialX = {index}m\n" for index in range(1000))
    scenario = folder.load(keys + "[X]\n*.numUavs = 1000\n*.numSmall = 0\n", "X")
    assert [node.initial_position[0] for node in scenario.nodes[1:]] == list(range(1000))


def test_a_start_too_far_away_is_an_error_at_its_line(folder: Any) -> None:
    error = folder.mistake("*.uavs[*].mobility.initialX = 1e9m\n")
    assert (error.line, error.key, error.value) == (6, "*.uavs[*].mobility.initialX", "1e9m")


def test_a_line_that_leads_too_far_is_an_error_at_its_step(folder: Any) -> None:
    error = folder.mistake("*.uavs[*].mobility.lineStartY = 1m\n*.uavs[*].mobility.lineStepY = 10000km\n")
    assert (error.line, error.key) == (7, "*.uavs[*].mobility.lineStepY")
    assert all(part in error.problem for part in ("uavs[1]", "y = 10000001m"))
    assert " 10000000m " in error.expected


def test_a_value_may_depend_on_the_index_of_the_node(folder: Any) -> None:
    scenario = folder.load(
        "*.uavs[*].mobility.initialX = 50m * parentIndex()\n"
        "*.uavs[*].protocol.retries = 3 + parentIndex()\n"
        '*.uavs[*].protocol.label = "uav " + string(parentIndex())\n'
        "*.uavs[*].numWlanInterfaces = index + 1\n"
        "*.uavs[*].wlan[*].bitrate = select(parentIndex(), 6Mbps, 12Mbps)\n"
        "*.uavs[*].wlan[*].radio.transmitter.power = (ancestorIndex(3) + 1) * (ancestorIndex(2) + 1) * 1mW\n"
    )
    uavs = [node for node in scenario.nodes if node.group == "uavs"]
    assert [node.initial_position[0] for node in uavs] == [0, 50]
    assert [node.protocol_parameters["retries"] for node in uavs] == [3, 4]
    assert [node.protocol_parameters["label"] for node in uavs] == ["uav 0", "uav 1"]
    assert [len(node.wlan) for node in uavs] == [1, 2]
    assert [node.wlan[0].mac["bitrate_bps"].value for node in uavs] == [6e6, 12e6]
    powers = [[wlan.radio["tx_power_w"].value for wlan in node.wlan] for node in uavs]
    assert powers == [[0.001], [0.002, 0.004]]


def test_the_value_of_one_node_that_is_wrong_is_named(folder: Any) -> None:
    error = folder.mistake("*.uavs[*].mobility.speed = 3mps - 5mps * parentIndex()\n")
    assert error.line == 6
    assert all(part in error.problem for part in (" -2mps ", " uavs[1].mobility.speed:"))


def test_the_class_of_a_protocol_knows_no_index(folder: Any) -> None:
    added = '*.others.count = 2\n*.others[*].protocol.class = choose(parentIndex(), "a b")\n'
    assert " index" in folder.error(added)
