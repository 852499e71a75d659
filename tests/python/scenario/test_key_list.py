import pytest

from gradysim.scenario.key_list import KeyRow, key_meant, key_sections, matching
from gradysim.scenario.schema.engine_keys import HAS_TO_BE_GIVEN
from gradysim.scenario.schema.keys import NETWORK_KEYS, NODE_KEYS


def row(end: str) -> KeyRow:
    """Return the row of the key with that end."""
    (found,) = [row for section in key_sections() for row in section.rows if row.key.endswith(end)]
    return found


def keys(pattern: str) -> list[str]:
    return [row.key for section in matching(key_sections(), pattern) for row in section.rows]


def test_every_key_is_listed_with_a_meaning_and_a_unit() -> None:
    rows = [row for section in key_sections() for row in section.rows]
    assert all(row.meaning and row.unit and row.default for row in rows)
    assert len(rows) > len((*NODE_KEYS, *NETWORK_KEYS))


@pytest.mark.parametrize(
    ("end", "written"),
    [
        ("sensitivity", "-85dBm; 802.15.4: -100dBm"),
        ("transmitter.power", "20mW; 802.15.4: 2.24mW"),
        ("centerFrequency", "2412MHz; 802.15.4: 2450MHz"),
        ("channelNumber", "0; 802.15.4: 20"),
        ("bandName", '"2.4 GHz"; 802.15.4: none'),
        ("snirThreshold", "1dB; 802.15.4: -8dB"),
        ("transmissionRange", "none"),
        ("beamWidth", HAS_TO_BE_GIVEN),
    ],
)
def test_defaults_are_written_as_in_a_file(end: str, written: str) -> None:
    assert row(end).default == written


def test_a_meaning_begins_with_the_models_that_read_the_key() -> None:
    assert row("pathLoss.k").meaning.startswith("RicianFading: ")
    assert row("macMinBE").meaning.startswith("802.15.4, exponential: ")
    assert ": " not in row("opMode").meaning


@pytest.mark.parametrize("pattern", ["POWER", "*.transmitter.power", "wlan[*].radio.transmitter.pow"])
def test_patterns(pattern: str) -> None:
    assert "*.nodes[*].wlan[*].radio.transmitter.power" in keys(pattern)


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("stationarymobility", "*.nodes[*].mobility.typename"),  # one of its values
        ("2.4 ghz", "*.nodes[*].wlan[*].radio.bandName"),  # another one
        ("10mps", "*.nodes[*].mobility.speed"),  # its default
        ("ArduPilot", "*.nodes[*].mobility.autopilotPath"),  # its meaning
    ],
)
def test_a_text_is_found_in_values_and_meanings_in_any_case(text: str, key: str) -> None:
    assert key in keys(text)


def test_a_pattern_is_one_of_keys() -> None:
    assert keys("*ArduPilot*") == []


@pytest.mark.parametrize("index", ["0", "1", "12", "1..3", "2..", "..3"])
def test_what_is_asked_of_one_interface_is_found_for_any(index: str) -> None:
    assert keys(f"wlan[{index}]") == keys("wlan[*]") != []


def test_what_does_not_match_is_left_out() -> None:
    assert keys("nonsense") == []


@pytest.mark.parametrize("group", ["uavs[*]", "uavs[3]", "groundStation", "nodes[*]"])
def test_what_is_asked_of_a_group_is_found_for_any(group: str) -> None:
    assert keys(f"*.{group}.mobility.speed") == ["*.nodes[*].mobility.speed"]


@pytest.mark.parametrize("pattern", ["numNodes", "*.numNodes", "numUavs", "*.numSensors", "**.numSensors"])
def test_the_number_of_nodes_of_any_group_is_found(pattern: str) -> None:
    assert keys(pattern)[0] == "*.numNodes"


@pytest.mark.parametrize("pattern", ["*.nodes.count", "*.uavs.count", "nodes.count"])
def test_the_number_of_nodes_is_found_below_the_group(pattern: str) -> None:
    assert keys(pattern) == ["*.nodes.count"]


def test_other_numbers_are_none_of_nodes() -> None:
    assert keys("numWlanInterfaces") == ["*.nodes[*].numWlanInterfaces"]
    assert keys("numWlanIterfaces") == []


@pytest.mark.parametrize("group", ["nodes[*]", "uavs[*]", "groundStation"])
def test_a_pattern_that_keys_begin_with_finds_them(group: str) -> None:
    assert keys(f"*.{group}.mobility") == keys("nodes[*].mobility") != []
    assert keys(f"*.{group}.mobility.separation") == [
        f"*.nodes[*].mobility.separation{axis}" for axis in "XY"
    ]


def test_keys_that_match_are_all_of_a_pattern() -> None:
    assert keys("*.radioMedium.pathLoss.alpha") == ["*.radioMedium.pathLoss.alpha"]


def test_the_network_has_parts_that_are_no_groups() -> None:
    assert keys("*.radioMedium.pathLoss.k") == ["*.radioMedium.pathLoss.k"]
    assert keys("*.radioMedium.mobility.speed") == []


@pytest.mark.parametrize(
    ("pattern", "hint"),
    [
        ("sensitivty", "; did you mean `sensitivity`?"),
        ("mobility speed", "; did you mean `mobility.speed`?"),
        ("sim time limit", "; did you mean `sim-time-limit`?"),
        ("zzz", ""),
    ],
)
def test_the_nearest_name_is_suggested(pattern: str, hint: str) -> None:
    assert key_meant(key_sections(), pattern) == hint
