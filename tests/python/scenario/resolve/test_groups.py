from pathlib import Path

import pytest

from gradysim.scenario.errors import ConfigError, ErrorCollector, Source
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.resolve.groups import Group, find_groups
from gradysim.scenario.resolve.lines import Lines
from gradysim.scenario.schema.keys import GROUP_SIZE
from gradysim.scenario.schema.values import SettingReader


def groups_of(*sections: str) -> list[Group]:
    """Return groups of entries `key = value`.

    The first section is searched first, the last one is General.
    """
    entries = []
    for rank, section in enumerate(sections, start=1):
        for line, written in enumerate(section.split("\n"), start=1):
            key, _, text = (part.strip() for part in written.partition("="))
            entries.append(Entry(key, text, Source(Path("a.ini"), line, key, text), rank))
    errors = ErrorCollector()
    groups = find_groups(Lines(entries), SettingReader(), errors)
    errors.raise_all()
    return groups


def names_of(*sections: str) -> list[str]:
    return [name for group in groups_of(*sections) for name in group.node_names()]


@pytest.mark.parametrize("size", ["*.numUavs = 2", "*.uavs.count = 2", "**.numUavs = 2", "**.uavs.count = 2"])
def test_a_number_makes_nodes_with_an_index(size: str) -> None:
    assert names_of(size) == ["uavs[0]", "uavs[1]"]


@pytest.mark.parametrize("key", ["*.groundStation.protocol.class", "**.groundStation.protocol.class"])
def test_a_class_makes_a_single_node(key: str) -> None:
    (group,) = groups_of(f'{key} = "x"')
    assert (group.node_names(), group.size, group.written) == (
        ["groundStation"],
        None,
        "groundStation",
    )


def test_a_group_of_one_has_an_index() -> None:
    assert names_of("*.numUavs = 1") == ["uavs[0]"]


def test_other_keys_make_no_nodes() -> None:
    assert names_of('*.a.mobility.speed = 1\n*.b[*].protocol.class = "x"\n*.c*.protocol.class = "x"') == []


def test_the_first_number_in_search_order_counts() -> None:
    assert names_of("*.uavs.count = 1", "*.numUavs = 2") == ["uavs[0]"]
    assert names_of("*.numUavs = default", "*.uavs.count = 2") == []


def test_the_number_may_be_written_in_other_case_than_the_group() -> None:
    assert names_of("*.numUAVs = 1\n*.uavs[*].x.y = 1") == ["uavs[0]"]
    assert names_of("*.numUavs = 1\n*.UAVs[*].x.y = 1") == ["UAVs[0]"]


@pytest.mark.parametrize(
    "lines",
    [
        '*.numUavs = 1\n*.uavs[*].protocol.class = "x"\n*.Uavs[*].x.y = 1',
        '*.Uavs[*].x.y = 1\n*.numUavs = 1\n*.uavs[*].protocol.class = "x"',
        '*.UAVS.protocol.speed = 1\n*.uavs[*].protocol.class = "x"\n*.Uavs[*].x.y = 1\n*.numUavs = 1',
    ],
)
def test_a_number_is_for_one_of_several_spellings_that_which_has_a_protocol(lines: str) -> None:
    assert names_of(lines) == ["uavs[0]"]


def test_groups_that_differ_in_case_may_have_numbers_of_their_own() -> None:
    lines = '*.numUavs = 1\n*.uavs[*].protocol.class = "x"\n*.Uavs.count = 2\n*.Uavs[*].protocol.class = "x"'
    assert names_of(lines) == ["uavs[0]", "Uavs[0]", "Uavs[1]"]


def test_order_is_that_of_first_mention_general_first() -> None:
    own = "*.numUavs = 1\n*.numSensors = 1"
    general = '*.base.protocol.class = "x"\n*.sensors[*].x.y = 1\n*.uavs[*].x.y = 1'
    assert names_of(own, general) == ["base", "sensors[0]", "uavs[0]"]


def test_parts_of_the_network_are_no_groups() -> None:
    assert names_of("*.radioMedium.count = 1\n*.visualizer.count = 1") == []


@pytest.mark.parametrize("text", ["-1", "2.5", "2m", "true", "nan", "1000001"])
def test_numbers_of_nodes_are_whole(text: str) -> None:
    with pytest.raises(ConfigError) as caught:
        groups_of(f"*.numUavs = {text}")
    error = caught.value
    assert (error.line, error.key, error.value) == (1, "*.numUavs", text)
    assert error.expected == GROUP_SIZE.kind.expected
