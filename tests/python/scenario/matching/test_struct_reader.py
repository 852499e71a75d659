"""Fields of a struct, from the entries in force."""

from pathlib import Path

from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.file.sections import Ranked
from gradysim.scenario.matching.lookup import Lookup
from gradysim.scenario.matching.struct_reader import read_struct
from gradysim.scenario.parameter_types import number, quantity
from gradysim.scenario.schema import Key
from gradysim.scenario.settings import SettingReader

POWER = Key("radio.power", "radio.power_w", quantity("W"), "")
LEVEL = Key("radio.level", "radio.power_w", quantity("W"), "")  # another key for the same field
GAIN = Key("radio.gain", "radio.gain", number(), "")
SPEED = Key("mobility.speed", "mobility.speed_mps", quantity("mps"), "")


def radio(*lines: str, node: str = "uavs[0]") -> dict[str, object]:
    """The fields of a node's radio that lines of a file set."""
    entries = [line.partition("=") for line in lines]
    lookup = Lookup(
        [
            Ranked(0, Entry(key, text, Source(Path("a.ini"), number, key), "General"))
            for number, (key, _, text) in enumerate(entries)
        ]
    )
    found = {key: lookup.first(node, key.path) for key in (POWER, LEVEL, GAIN, SPEED)}
    found = {key: entry for key, entry in found.items() if entry is not None}
    settings = read_struct("radio", found, SettingReader(), lambda key: f"{node}.{key.path}")
    return {field: setting.value for field, setting in settings.items()}


def test_only_what_is_set_of_that_struct_is_a_field() -> None:
    assert radio("*.uavs[*].radio.gain=3", "*.uavs[*].mobility.speed=4mps") == {"gain": 3}


def test_of_two_keys_for_one_field_the_first_line_is_in_force() -> None:
    power, level = "*.uavs[*].radio.power=1W", "*.uavs[*].radio.level=2W"
    assert (radio(power, level), radio(level, power)) == ({"power_w": 1}, {"power_w": 2})


def test_a_default_that_comes_first_keeps_the_other_line_out() -> None:
    assert radio("*.uavs[*].radio.level=default", "*.uavs[*].radio.power=1W") == {}


def test_each_node_draws_its_own() -> None:
    """The path of the parameter is what tells the nodes from each other."""
    line = "*.uavs[*].radio.gain=uniform(0, 1)"
    assert len({radio(line, node=f"uavs[{number}]")["gain"] for number in range(3)}) == 3
