from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.file.sections import Ranked
from gradysim.scenario.matching.lookup import Lookup, network_name
from gradysim.scenario.patterns import compile_pattern


def entries(*keys: str) -> list[Ranked]:
    """Entries in search order; the value is the position."""
    return [
        Ranked(1, Entry(key, str(order), Source(Path("a.ini"), order + 1, key), "General"))
        for order, key in enumerate(keys)
    ]


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
    ranked = entries("Other.a.b", "Network.a.b")
    assert in_force(Lookup(ranked), "a", "b") == "1"
    network = Entry("network", '"pkg.Other"', Source(Path("a.ini"), 9), "General")
    assert in_force(Lookup([*ranked, (1, network)]), "a", "b") == "0"


def test_the_name_of_the_network_has_no_variables() -> None:
    network = Entry("network", "${x=A, B}", Source(Path("a.ini"), 9, "network", "${x=A, B}"), "General")
    with pytest.raises(ConfigError) as caught:
        network_name(network)
    assert str(caught.value) == (
        "a.ini:9: network = ${x=A, B}: it is the same in all runs; expected a name without variables"
    )


@pytest.mark.parametrize(
    ("text", "name"),
    [("Field", "Field"), ('"Field"', "Field"), ("a.b_2.Field", "Field"), ('"a.Field"', "Field")],
)
def test_the_name_of_the_network_may_follow_packages(text: str, name: str) -> None:
    assert network_name(Entry("network", text, Source(Path("a.ini"), 9), "General")) == name


@pytest.mark.parametrize(
    "text", ["a.", ".a", "*", "a b", "a..b", '"a', "2a", '""', "a-b", "a.*", "fl\u00e4che"]
)
def test_what_is_no_name_of_a_network_is_refused(text: str) -> None:
    network = Entry("network", text, Source(Path("a.ini"), 9, "network", text), "General")
    with pytest.raises(ConfigError) as caught:
        network_name(network)
    assert str(caught.value) == (
        f"a.ini:9: network = {text}: expected the name of a network, such as `Network` or `package.Network`"
    )


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
