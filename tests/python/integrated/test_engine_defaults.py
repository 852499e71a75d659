import math
import re

import pytest

from gradysim import _netsim
from gradysim.integrated.engine_defaults import engine_defaults
from gradysim.protocol.defaults import LEAST_TELEMETRY_INTERVAL_S, SPEED_MPS, UPDATE_S
from gradysim.scenario.expressions import parse_value
from gradysim.scenario.key_list import OWN_STRUCTS, UNKNOWN, key_sections
from gradysim.scenario.keys import NETWORK_KEYS, NODE_KEYS
from gradysim.scenario.keys.mobility import ARDUPILOT, STATIC_GRID

MADE_WITH = {
    "medium.typename": _netsim.MediumConfig,
    "interface.typename": lambda name: _netsim.NodeConfig("node", [name]),
}
"""What takes a name at the start only."""

NOT_NAMES_OF_THE_ENGINE = {"radio.carrier_hz", "obstacle.typename"}
"""The name of a band becomes a frequency, boxes become prisms."""

SAID_IN_OTHER_WORDS = {ARDUPILOT, STATIC_GRID}
"""Names that the reader of files turns into what the engine knows."""

CHOICES = {
    key.target: [
        name for name in re.findall(r'"([^"]*)"', key.kind.expected) if name not in SAID_IN_OTHER_WORDS
    ]
    for key in (*NODE_KEYS, *NETWORK_KEYS)
    if key.kind.expected.startswith(("one of", '"')) and key.target not in NOT_NAMES_OF_THE_ENGINE
}
"""{"struct.field": the names that a file may write there}"""


def a_valid_obstacle():
    obstacle = _netsim.ObstacleConfig()
    obstacle.rings, obstacle.base_m, obstacle.top_m = [[(0, 0), (1, 0), (0, 1)]], 0, 1
    return obstacle


def validate_with(target, value):
    struct, _, field = target.partition(".")
    config = a_valid_obstacle() if struct == "obstacle" else engine_defaults()[struct][""]
    setattr(config, field, value)
    config.validate(*([2.4e9] if struct == "antenna" else []))


def give_a_wrong_name(target):
    if target in MADE_WITH:
        MADE_WITH[target]("?")
    validate_with(target, "?")


@pytest.mark.parametrize("target", CHOICES)
def test_names_that_a_file_may_write_are_those_of_the_engine(target):
    with pytest.raises(ValueError, match=r" = \"\?\": expected ") as error:
        give_a_wrong_name(target)
    told = re.search(r"expected (?:one of )?(.*?)(?:; did you mean .*)?$", str(error.value))
    known = [name.removeprefix('"" (none)') for name in told[1].split(", ")]
    assert CHOICES[target] == known


OF_OTHER_ANTENNAS = {"antenna.beam_width_rad", "antenna.min_gain"}
"""Which the default one has no use for, and does not check."""

NUMBERS = sorted(
    f"{struct}.{field}"
    for struct, named in engine_defaults().items()
    for field in dir(named[""])
    if isinstance(getattr(named[""], field), float) and getattr(type(named[""]), field).fset
)


@pytest.mark.parametrize("target", [each for each in NUMBERS if each not in OF_OTHER_ANTENNAS])
def test_no_number_is_taken_unchecked(target):
    with pytest.raises(ValueError, match="nan"):
        validate_with(target, math.nan)


def test_every_default_is_known() -> None:
    rows = [row for section in key_sections(engine_defaults()) for row in section.rows]
    assert [row.key for row in rows if row.default == UNKNOWN] == []


def test_every_default_that_is_listed_may_be_written() -> None:
    structs = {**engine_defaults(), **OWN_STRUCTS}
    for key in (*NODE_KEYS, *NETWORK_KEYS):
        if not key.default:
            default = getattr(structs[key.struct][""], key.field)
            assert key.kind.convert(parse_value(key.kind.show(default))) is not None, key.path


def test_nodes_of_which_nothing_is_said_move_the_same_in_both_modes() -> None:
    mobility = engine_defaults()["mobility"][""]
    assert (mobility.speed_mps, mobility.telemetry_interval_s) == (SPEED_MPS, UPDATE_S)


def test_the_least_telemetry_interval_is_the_same_in_both_modes() -> None:
    validate_with("mobility.telemetry_interval_s", LEAST_TELEMETRY_INTERVAL_S)
    with pytest.raises(ValueError, match="telemetry_interval_s"):
        validate_with("mobility.telemetry_interval_s", math.nextafter(LEAST_TELEMETRY_INTERVAL_S, 0))
