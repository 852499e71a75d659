from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.scenario.doubts.shadowed_lines import shadowed_lines
from gradysim.scenario.file.reader import read_ini
from gradysim.scenario.file.sections import search_order

Write = Callable[..., Path]


def told(file: Path, config: str = "General") -> list[str]:
    return shadowed_lines(search_order(read_ini(file), config))


def test_a_special_line_below_a_general_one_is_told(write_ini: Write) -> None:
    file = write_ini("*.uavs[*].mobility.speed = 3mps\n*.uavs[1].mobility.speed = 5mps\n")
    assert told(file) == [
        f"{file}:2: warning: `*.uavs[1].mobility.speed` has no effect: line 1, `*.uavs[*].mobility.speed`,"
        " fits as well and comes first; expected the special line above the general one"
    ]


@pytest.mark.parametrize(
    ("above", "below"),
    [
        ("*.numUavs", "*.numUavs"),
        ("repeat", "repeat"),
        ("**.speed", "*.uavs[0].mobility.speed"),
        ("**.speed", "*.uavs[*].**.speed"),
        ("**.mobility.*", "**.mobility.speed"),
        ("*.*.mobility.speed", "*.uavs[0..3].mobility.speed"),
        ("*.uavs[*].mobility.speed", "*.uavs[0..3].mobility.speed"),
        ("*.uavs[0..3].mobility.speed", "*.uavs[2].mobility.speed"),
        ("**.wlan[*].bitrate", "*.uavs[*].wlan[0].bitrate"),
        ("*.uavs[*].mobility.initialX", "*.uavs[*].mobility.lineStepX"),
        ("*.uavs[*].mobility.lineStepY", "*.uavs[0].mobility.initialY"),
        ("*.uav.mobility.initialZ", "*.uav.mobility.lineStartZ"),
        ("*.uavs[*].mobility.separationX", "*.uavs[0].mobility.initialX"),
        ("*.uavs[*].mobility.lineStepY", "*.uavs[*].mobility.separationY"),
        ("*.uavs[*].mobility.lineStartX", "*.uavs[*].mobility.separationX"),
        ("*.uavs[*].mobility.initialY", "*.uavs[0].mobility.separationY"),
        ("*.uavs[*].mobility.separationY", "*.uavs[*].mobility.lineStartY"),
        ("*.uavs[*].mobility.separationX", "*.uavs[0].mobility.lineStepX"),
        ("**.radio.centerFrequency", "*.uavs[0].wlan[0].radio.channelNumber"),
        ("**.radio.channelNumber", "*.uavs[0].wlan[0].radio.centerFrequency"),
        ("*.numUavs", "*.uavs.count"),
        ("*.uavs.count", "*.numUavs"),
        ("*.uavs[*].protocol.class", "*.uavs[*].protocol.typename"),
        ("*.uavs[*].protocol.typename", "*.uavs[0].protocol.class"),
        ("*.uav.wlan[*].radio.transmitter.power", "*.uav.wlan[*].radio.transmitter.communicationRange"),
        ("*.uav.wlan[*].radio.transmitter.communicationRange", "*.uav.wlan[0].radio.transmitter.power"),
        ("**.transmitter.power", "*.uav.wlan[*].radio.transmitter.power"),
        ("**.communicationRange", "**.transmitter.power"),
        ("**.transmitter.power", "**.communicationRange"),
    ],
)
def test_what_has_no_effect(write_ini: Write, above: str, below: str) -> None:
    (text,) = told(write_ini(f"{above} = 1\n{below} = 2\n"))
    assert f"`{below}` has no effect: line 1, `{above}`" in text


@pytest.mark.parametrize(
    ("above", "below"),
    [
        ("*.numUavs", "*.sensors.count"),
        ("*.uavs[0].protocol.class", "*.uavs[*].protocol.typename"),
        ("*.uavs[1].mobility.speed", "*.uavs[*].mobility.speed"),
        ("*.uavs[*].mobility.speed", "**.speed"),
        ("*.uavs[*].mobility.speed", "*.*.mobility.speed"),
        ("*.uavs[0..3].mobility.speed", "*.uavs[2..5].mobility.speed"),
        ("*.uavs[0..3].mobility.speed", "*.uavs[4].mobility.speed"),
        ("*.*.speed", "**.speed"),
        ("*.uavs[0].mobility.speed", "*.uavs[1].mobility.speed"),
        ("*.uavs[*].mobility.lineStartX", "*.uavs[*].mobility.lineStepX"),
        ("*.uavs[*].mobility.initialX", "*.uavs[*].mobility.lineStepY"),
        ("*.uavs[0].mobility.initialX", "*.uavs[*].mobility.lineStepX"),
        (
            "*.uavs[0].wlan[*].radio.transmitter.power",
            "*.uavs[*].wlan[*].radio.transmitter.communicationRange",
        ),
        ("**.communicationRange", "*.radioMedium.backgroundNoise.power"),
        ("cmdenv-status-frequency", "cmdenv-status-frequency"),
    ],
)
def test_what_has_one(write_ini: Write, above: str, below: str) -> None:
    assert told(write_ini(f"{above} = 1\n{below} = 2\n")) == []


@pytest.mark.parametrize(
    ("above", "below"),
    [("*.numUavs", "*.numUavs"), ("*.uavs[0].mobility.initialX", "*.uavs[0].mobility.lineStepX")],
)
def test_no_order_helps_lines_that_say_the_same_thing(write_ini: Write, above: str, below: str) -> None:
    (text,) = told(write_ini(f"{above} = 1\n{below} = 2\n"))
    assert text.endswith(f"`{above}`, says the same thing and comes first; expected one of them")


def test_a_line_without_effect_deprives_no_other_of_its_own(write_ini: Write) -> None:
    file = write_ini("**.lineStartX = 1m\n**.initialX = 1m\n**.lineStepX = 1m\n")
    (text,) = told(file)
    assert text.startswith(f"{file}:2: ")


def test_a_line_that_says_the_same_does_no_harm(write_ini: Write) -> None:
    file = write_ini("*.uavs[*].mobility.speed = 3mps\n*.uavs[1].mobility.speed = 3mps\n")
    assert told(file) == []


@pytest.mark.parametrize("lines", [["*.numUavs", "*.uavs.count"], ["*.uavs.count", "*.numUavs"]])
def test_two_equal_counts_of_a_group_do_no_harm(write_ini: Write, lines: list[str]) -> None:
    assert told(write_ini("".join(f"{line} = 2\n" for line in lines))) == []


def test_another_section_and_an_included_file_are_there_to_be_overridden(write_ini: Write) -> None:
    write_ini("**.speed = 1mps\n", "base.ini")
    file = write_ini("**.speed = 2mps\ninclude base.ini\n[Config A]\n**.speed = 3mps\n")
    assert told(file, "A") == []


def test_only_sections_of_the_configuration_are_looked_at(write_ini: Write) -> None:
    file = write_ini("[Config A]\nrepeat = 2\n[Config B]\nrepeat = 2\nrepeat = 3\n")
    assert told(file, "A") == []
    assert len(told(file, "B")) == 1


POWER_AND_RANGE = ["**.transmitter.power = {}\n", "**.transmitter.communicationRange = {}\n"]


@pytest.mark.parametrize("lines", [POWER_AND_RANGE, POWER_AND_RANGE[::-1]])
def test_a_range_deprives_no_power_where_there_are_none(write_ini: Write, lines: list[str]) -> None:
    sections = search_order(read_ini(write_ini("".join(lines).format("1mW", "2m"))), "General")
    assert shadowed_lines(sections, has_powers=False) == []


@pytest.mark.parametrize("lines", [POWER_AND_RANGE, POWER_AND_RANGE[::-1]])
def test_a_default_deprives_no_line_that_says_the_same_in_other_words(
    write_ini: Write, lines: list[str]
) -> None:
    assert told(write_ini("".join(lines).format("default", "2"))) == []


def test_a_default_deprives_the_same_key_of_its_effect(write_ini: Write) -> None:
    power, _ = POWER_AND_RANGE
    (text,) = told(write_ini(power.format("default") + power.format("1mW")))
    assert "says the same thing" in text


def test_a_range_in_another_section_overrides_a_power(write_ini: Write) -> None:
    power, reach = (line.format("2") for line in POWER_AND_RANGE)
    assert told(write_ini(f"[General]\n{power}[Config X]\n{reach}"), "X") == []


@pytest.mark.parametrize(
    "line", ["**.uavs[{}].wlan[*].radio.power = 1mW\n", "*.g{}[*].mobility.speed = 3mps\n"]
)
def test_general_lines_about_other_nodes_are_not_compared(
    write_ini: Write, count_matches: Callable[..., int], line: str
) -> None:
    lines = "".join(line.format(index) for index in range(50))
    assert count_matches(lambda: told(write_ini(lines + line.format(7)))) <= 1
