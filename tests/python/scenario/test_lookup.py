"""Fields of a struct, from the effective entries."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors import ConfigError, ErrorCollector, Source
from gradysim.scenario.ini import Entry
from gradysim.scenario.lookup import Lookup, SettingReader, network_name, read_struct
from gradysim.scenario.parameter_types import number, quantity
from gradysim.scenario.patterns import compile_pattern
from gradysim.scenario.schema import Key


def entries(*keys: str) -> list[Entry]:
    """Return entries in search order; the value is the position."""
    return [Entry(key, str(order), Source(Path("a.ini"), order + 1, key)) for order, key in enumerate(keys)]


def in_force(lookup: Lookup, name: str, rest: str = "") -> str | None:
    found = lookup.first(name, rest)
    return found.entry.text if found else None


def test_the_first_match_wins() -> None:
    lookup = Lookup(entries("*.uavs[3].x.y", "*.uavs[*].x.y", "**.y", "*.uavs[4].x.y"))
    assert in_force(lookup, "uavs[3]", "x.y") == "0"
    assert in_force(lookup, "uavs[4]", "x.y") == "1"
    assert in_force(lookup, "sensors[4]", "x.y") == "2"
    assert in_force(lookup, "sensors[4]", "x.z") is None


def test_paths_of_two_parts() -> None:
    lookup = Lookup(entries("*.numUavs.x", "*.numUavs", "**.numSensors"))
    assert in_force(lookup, "numUavs") == "1"
    assert in_force(lookup, "numSensors") == "2"


def test_paths_begin_with_the_name_of_the_network() -> None:
    written = entries("Other.a.b", "Network.a.b")
    assert in_force(Lookup(written), "a", "b") == "1"
    network = Entry("network", '"pkg.Other"', Source(Path("a.ini"), 9))
    assert in_force(Lookup([*written, network]), "a", "b") == "0"


def test_the_name_of_the_network_has_no_variables() -> None:
    network = Entry("network", "${x=A, B}", Source(Path("a.ini"), 9, "network", "${x=A, B}"))
    with pytest.raises(ConfigError) as caught:
        network_name([network])
    assert caught.value.line == 9


@pytest.mark.parametrize(
    ("text", "name"),
    [("Field", "Field"), ('"Field"', "Field"), ("a.b_2.Field", "Field"), ('"a.Field"', "Field")],
)
def test_the_name_of_the_network_may_follow_packages(text: str, name: str) -> None:
    assert network_name([Entry("network", text, Source(Path("a.ini"), 9))]) == name


@pytest.mark.parametrize(
    "text", ["a.", ".a", "*", "a b", "a..b", '"a', "2a", '""', "a-b", "a.*", "fl\u00e4che"]
)
def test_what_is_no_name_of_a_network_is_refused(text: str) -> None:
    network = Entry("network", text, Source(Path("a.ini"), 9, "network", text))
    with pytest.raises(ConfigError) as caught:
        network_name([network])
    assert (caught.value.line, caught.value.value) == (9, text)


def test_what_omnetpp_alone_reads_is_left_out() -> None:
    keys = [
        "*.visualizer.a.b",
        "**.visualizer.**.c",
        "**.cmdenv-log-level",
        "*.uavs[*].x.y",
        "*.uavs[*].protocol.network",
    ]
    assert [found.entry.key for found in Lookup(entries(*keys)).found] == keys[3:]


def test_a_bad_pattern_is_an_error_with_its_line() -> None:
    with pytest.raises(ConfigError) as caught:
        Lookup(entries("*.a.b", "*.a{.b"))
    assert (
        str(caught.value)
        == "a.ini:2: *.a{.b: `{` is not closed; expected `}` after it (a plain brace is written `\\{`)"
    )


KEYS = st.from_regex(
    r"(\*|\*\*|N)\.([ab*?]{1,2}(\[(\*|0|1|1\.\.|\*\*)\])?)(\.(x|\*|\*\*|x\.y|\*\*\.y|z))?",
    fullmatch=True,
)


@given(
    st.lists(KEYS, max_size=6),
    st.sampled_from(["a", "a[0]", "a[1]", "ab[2]"]),
    st.sampled_from(["", "x", "x.y", "z.x.y"]),
)
def test_agrees_with_matching_whole_paths_one_by_one(keys: list[str], name: str, rest: str) -> None:
    path = ".".join(["Network", name, *([rest] if rest else [])])
    expected = next(
        (str(order) for order, key in enumerate(keys) if compile_pattern(key).matches(path)),
        None,
    )
    assert in_force(Lookup(entries(*keys)), name, rest) == expected


POWER = Key("radio.power", "radio.power_w", quantity("W"), "")
LEVEL = Key("radio.level", "radio.power_w", quantity("W"), "")  # another key for the same field
GAIN = Key("radio.gain", "radio.gain", number(), "")
SPEED = Key("mobility.speed", "mobility.speed_mps", quantity("mps"), "")


def radio(*lines: str, node: str = "uavs[0]") -> dict[str, object]:
    """Return the fields of a node's radio, as set by lines of a file."""
    entries = [line.partition("=") for line in lines]
    lookup = Lookup(
        [
            Entry(key, text, Source(Path("a.ini"), number, key))
            for number, (key, _, text) in enumerate(entries)
        ]
    )
    found = {key: lookup.first(node, key.path) for key in (POWER, LEVEL, GAIN, SPEED)}
    found = {key: entry for key, entry in found.items() if entry is not None}
    errors = ErrorCollector()
    settings = read_struct("radio", found, SettingReader(), lambda key: f"{node}.{key.path}", errors)
    errors.raise_all()
    return {field: setting.value for field, setting in settings.items()}


def test_only_what_is_set_of_that_struct_is_a_field() -> None:
    assert radio("*.uavs[*].radio.gain=3", "*.uavs[*].mobility.speed=4mps") == {"gain": 3}


def test_of_two_keys_for_one_field_the_first_line_is_in_force() -> None:
    power, level = "*.uavs[*].radio.power=1W", "*.uavs[*].radio.level=2W"
    assert (radio(power, level), radio(level, power)) == ({"power_w": 1}, {"power_w": 2})


def test_a_default_that_comes_first_keeps_the_other_line_out() -> None:
    assert radio("*.uavs[*].radio.level=default", "*.uavs[*].radio.power=1W") == {}


def test_each_node_draws_its_own() -> None:
    """The path of the parameter distinguishes the nodes."""
    line = "*.uavs[*].radio.gain=uniform(0, 1)"
    assert len({radio(line, node=f"uavs[{number}]")["gain"] for number in range(3)}) == 3
