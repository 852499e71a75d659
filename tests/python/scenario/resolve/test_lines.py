"""Which lines are about a parameter, and which of them is in force."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.parse.patterns import compile_pattern
from gradysim.scenario.resolve.lines import Lines, Schema
from gradysim.scenario.schema.engine_keys import Key
from gradysim.scenario.schema.parameter_types import number


def entries(*keys: str) -> list[Entry]:
    """Return entries in search order; the value is the position."""
    return [Entry(key, str(order), Source(Path("a.ini"), order + 1, key)) for order, key in enumerate(keys)]


def schema(*paths: str) -> Schema:
    return Schema({path: Key(path, f"x.{path}", number(), "") for path in paths})


def matching(lines: Lines, name: str, path: str = "") -> list[str]:
    """Return the positions of the lines that are about a parameter; the first is in force."""
    row = lines.rows(lines.names(name), schema(path)).get(path)
    return [line.entry.text for line in row.lines] if row else []


def test_the_first_match_hides_the_others() -> None:
    lines = Lines(entries("*.uavs[3].x.y", "*.uavs[*].x.y", "**.y", "*.uavs[4].x.y"))
    assert matching(lines, "uavs[3]", "x.y") == ["0", "1", "2"]
    assert matching(lines, "uavs[4]", "x.y") == ["1", "2", "3"]
    assert matching(lines, "sensors[4]", "x.y") == ["2"]
    assert matching(lines, "sensors[4]", "x.z") == []


def test_paths_of_two_parts() -> None:
    lines = Lines(entries("*.numUavs.x", "*.numUavs", "**.numSensors"))
    assert matching(lines, "numUavs") == ["1"]
    assert matching(lines, "numSensors") == ["2"]


def test_a_key_that_ends_in_a_dot_names_nothing() -> None:
    lines = Lines(entries("*.numUavs.", "**.numUavs.", "*.numUavs"))
    assert matching(lines, "numUavs") == ["2"]


def test_anything_below_the_network_may_be_a_name_and_more() -> None:
    lines = Lines(entries("Network.**.y", "*.**.x.y", "Other.**.y", "*.**.uavs[3].x.y", "*.**"))
    assert matching(lines, "uavs[3]", "x.y") == ["0", "1", "4"]
    assert matching(lines, "uavs[3]", "y") == ["0", "4"]


def test_subjects_with_the_same_general_lines_share_their_rows() -> None:
    lines = Lines(entries("*.uavs[2].x.y", "*.uavs[*].x.y", "Network.**.z"))
    of_node = schema("x.y", "z")
    rows = [lines.rows(lines.names(f"uavs[{index}]"), of_node) for index in range(3)]
    assert rows[0] is rows[1]
    assert rows[2]["z"] is rows[0]["z"]
    assert rows[2]["x.y"].general is rows[0]["x.y"]


def test_paths_begin_with_the_name_of_the_network() -> None:
    written = entries("Other.a.b", "Network.a.b")
    assert matching(Lines(written), "a", "b") == ["1"]
    network = Entry("network", '"pkg.Other"', Source(Path("a.ini"), 9))
    assert matching(Lines([*written, network]), "a", "b") == ["0"]


def test_what_omnetpp_alone_reads_is_left_out() -> None:
    keys = [
        "*.visualizer.a.b",
        "**.visualizer.**.c",
        "**.cmdenv-log-level",
        "*.uavs[*].x.y",
        "*.uavs[*].protocol.network",
    ]
    assert [line.entry.key for line in Lines(entries(*keys)).all] == keys[3:]


def test_a_bad_pattern_is_an_error_with_its_line() -> None:
    with pytest.raises(ConfigError) as caught:
        Lines(entries("*.a.b", "*.a{.b"))
    assert (caught.value.file, caught.value.line) == (Path("a.ini"), 2)
    assert "`}`" in caught.value.expected


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
    expected = [str(order) for order, key in enumerate(keys) if compile_pattern(key).matches(path)]
    assert matching(Lines(entries(*keys)), name, rest) == expected
