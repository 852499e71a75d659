import re
from dataclasses import replace
from pathlib import Path

import pytest

from gradysim.scenario.errors import ConfigError, ErrorCollector, Source
from gradysim.scenario.parse.expressions import ParameterContext
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.resolve.lines import Lines, Schema, read_struct
from gradysim.scenario.schema.engine_keys import Key
from gradysim.scenario.schema.parameter_types import (
    choice,
    coordinate,
    file_name,
    integer,
    node_coordinate,
    number,
    quantity,
    text,
)
from gradysim.scenario.schema.values import Setting, SettingReader, is_right_for_all_seeds, read_scalar

SPEED = quantity("mps", at_least=0)
MODE = choice("b", "a")


def entry(text: str, line: int = 7, option: str = "") -> Entry:
    return Entry("*.x.y", text, Source(Path("a.ini"), line, "*.x.y", text, option))


def test_holds_the_value_and_its_place() -> None:
    written = entry("36kmph")
    assert SettingReader().setting(written, SPEED) == Setting(10.0, written.source)


def test_reads_an_entry_once_for_each_kind() -> None:
    settings, written = SettingReader(), entry("3mps")
    one, other = (settings.setting(written, SPEED, f"{node}.mobility.speed") for node in ("a", "b"))
    assert one is other


def test_an_entry_for_two_kinds_has_a_value_of_each() -> None:
    settings, written = SettingReader(), entry("3")
    values = [settings.scalar(written, kind) for kind in (integer(), number())]
    assert [type(value) for value in values] == [int, float]


def test_knows_which_lines_were_read() -> None:
    settings, read, checked = SettingReader(), entry("3mps"), entry("4mps", line=8)
    settings.setting(read, SPEED, "uavs[0].mobility.speed")
    settings.for_checks().setting(checked, SPEED, "uavs[0].mobility.other")
    assert settings.lines_read() == {read.source}


def test_knows_which_files_were_named() -> None:
    settings = SettingReader()
    settings.setting(entry('"table.csv"'), file_name())
    settings.setting(entry('"no file"'), text())
    settings.setting(entry('""'), file_name())
    assert settings.files() == [Path("table.csv")]


def test_errors_name_the_place_the_entry_and_what_was_expected() -> None:
    with pytest.raises(ConfigError) as caught:
        read_scalar(entry("3mpss"), SPEED)
    error = caught.value
    assert (error.line, error.key, error.value) == (7, "*.x.y", "3mpss")
    assert (error.expected, error.suggestion) == (SPEED.expected, "mps")
    assert "`mpss`" in error.problem


def test_of_a_list_of_values_the_wrong_one_is_named() -> None:
    of_this_run = replace(entry("${v=3mps, -3mps}"), text="-3mps")
    with pytest.raises(ConfigError) as caught:
        read_scalar(of_this_run, SPEED)
    assert (caught.value.line, caught.value.expected) == (7, SPEED.expected)
    assert " -3mps: " in caught.value.problem


@pytest.mark.parametrize(
    "key",
    ["**", "*.x.*", "*.uavs[*].mobility.s*", "**.*speed", "**.speed", "**.*.speed", "*.uavs[*].*.speed"],
)
def test_a_parameter_that_the_key_leaves_open_is_named(key: str) -> None:
    written = Entry(key, "3m", Source(Path("a.ini"), 7, key, "3m"))
    with pytest.raises(ConfigError) as caught:
        read_scalar(written, SPEED, "uavs[0].mobility.speed")
    assert (caught.value.line, caught.value.expected) == (7, SPEED.expected)
    assert caught.value.problem.startswith(f"{key} = 3m: for uavs[0].mobility.speed: `m` ")


@pytest.mark.parametrize("key", ["*.uavs[*].mobility.speed", "**.mobility.speed"])
def test_a_parameter_that_the_key_says_in_full_is_not_repeated(key: str) -> None:
    written = Entry(key, "3m", Source(Path("a.ini"), 7, key, "3m"))
    with pytest.raises(ConfigError) as caught:
        read_scalar(written, SPEED, "uavs[0].mobility.speed")
    assert "uavs[0]" not in caught.value.problem


def test_texts_of_overrides_need_no_quotes() -> None:
    assert read_scalar(entry("b", line=0, option="--set"), MODE) == "b"
    assert read_scalar(entry('"b"', line=0, option="--set"), MODE) == "b"


def test_texts_in_a_file_need_quotes() -> None:
    with pytest.raises(ConfigError):
        read_scalar(entry("b"), MODE)


def test_files_are_seen_from_the_folder_of_the_ini_file() -> None:
    source = Source(Path("configs/a.ini"), 7, "*.x.y", '"table.csv"')
    assert read_scalar(Entry("*.x.y", '"table.csv"', source), file_name()) == "configs/table.csv"
    assert read_scalar(Entry("*.x.y", '"/table.csv"', source), file_name()) == "/table.csv"
    assert read_scalar(Entry("*.x.y", '""', source), file_name()) == ""


def test_what_is_drawn_is_another_value_for_each_parameter_and_seed() -> None:
    written = entry("uniform(1mps, 2mps)")
    settings, others = SettingReader(1), SettingReader(2)
    values = [
        reader.scalar(written, SPEED, f"{node}.mobility.speed")
        for reader in (settings, others, settings, SettingReader(1))
        for node in ("a", "b")
    ]
    assert len(set(values)) == 4
    assert values[:2] == values[4:6] == values[6:]


def test_without_a_parameter_nothing_is_drawn() -> None:
    with pytest.raises(ConfigError) as caught:
        SettingReader().setting(entry("uniform(1mps, 2mps)"), SPEED)
    assert (caught.value.line, caught.value.expected) == (7, SPEED.expected)
    assert caught.value.problem.startswith("*.x.y = uniform(1mps, 2mps): `uniform` ")


def test_a_drawn_number_that_is_out_of_range_is_told_with_its_parameter() -> None:
    with pytest.raises(ConfigError) as caught:
        read_scalar(entry("-exponential(2mps) - 3mps"), SPEED, "x.y", ParameterContext(1, "x.y"))
    assert (caught.value.line, caught.value.expected) == (7, SPEED.expected)
    assert re.search(r"3mps: .* -\S+mps for x\.y .*seed 1: ", caught.value.problem)


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("b", "b"),
        ('"b"', "b"),
        ('choose(parentIndex(), "b a")', "a"),
        ('"a"', "a"),
        ('parentIndex() > 0 ? "a" : "b"', "a"),
    ],
)
def test_an_override_of_a_text_is_an_expression_or_a_text_without_quotes(written: str, value: str) -> None:
    override = entry(written, option="--set")
    assert read_scalar(override, MODE, "x[1].mac.y", ParameterContext(1, "x[1].mac.y")) == value


@pytest.mark.parametrize("written", ["g(mixed)", "p.py:P", "1/0", "5", "a b"])
def test_an_override_that_is_no_expression_is_the_text_itself(written: str) -> None:
    kind = choice("g(mixed)") if "(" in written else text()
    assert read_scalar(entry(written, option="--set"), kind) == written


@pytest.mark.parametrize("written", ["parentIndx()", 'select(parentIndex(), "a")', 'false ? "a" : 1/0'])
def test_an_override_of_a_text_that_is_a_wrong_expression_is_refused(written: str) -> None:
    with pytest.raises(ConfigError) as caught:
        read_scalar(entry(written, option="--set"), text(), "x[1].label", ParameterContext(1, "x[1].mac.y"))
    assert "for x[1].label: " in caught.value.problem


def test_what_was_drawn_is_told_with_the_seed() -> None:
    with pytest.raises(ConfigError, match=r" -3.0mps .* x\[1\]\.y .* 7: "):
        read_scalar(entry("uniform(-3mps, -3mps)"), SPEED, "x[1].y", ParameterContext(7, "x[1].y"))


def test_a_truth_in_the_place_of_a_number_is_named_as_it_is_written() -> None:
    with pytest.raises(ConfigError, match=r" true .* x\[1\]\.mac\.y: "):
        read_scalar(entry("index == 1"), SPEED, "x[1].mac.y", ParameterContext(1, "x[1].y"))


@pytest.mark.parametrize("text", ["uniform(0m, 1km)", " uniform ( -5km,5m ) ", "50m * parentIndex()", "3m"])
def test_what_is_right_with_one_seed_is_so_with_all(text: str) -> None:
    assert is_right_for_all_seeds(text, node_coordinate())


@pytest.mark.parametrize(
    "text",
    [
        "uniform(0m, 1e12km)",
        "uniform(0m, index * 1m)",
        "uniform(0m, 1s)",
        "uniform(0m, uniform(0m, 1m))",
        "uniform(0m, 1m) + uniform(0m, 1m)",
        "1m / uniform(0, 1)",
        "normal(0m, 1m)",
        'select(intuniform(0, 1), 3m, "x")',
    ],
)
def test_others_may_be_wrong_with_another_seed(text: str) -> None:
    assert not is_right_for_all_seeds(text, node_coordinate())


def test_where_other_lines_count_all_seeds_have_to_be_tried() -> None:
    assert not is_right_for_all_seeds(
        "uniform(0m, 1km)", coordinate()
    )  # for example, of an obstacle, whose top must be above its bottom


POWER = Key("radio.power", "radio.power_w", quantity("W"), "")
LEVEL = Key("radio.level", "radio.power_w", quantity("W"), "")  # another key for the same field
GAIN = Key("radio.gain", "radio.gain", number(), "")
OF_MOBILITY = Key("mobility.speed", "mobility.speed_mps", quantity("mps"), "")


def radio(*lines: str, node: str = "uavs[0]") -> dict[str, object]:
    """Return the fields of a node's radio, as set by lines of a file."""
    entries = [line.partition("=") for line in lines]
    written = Lines(
        [
            Entry(key, text, Source(Path("a.ini"), number, key))
            for number, (key, _, text) in enumerate(entries)
        ]
    )
    schema = Schema({key.path: key for key in (POWER, LEVEL, GAIN, OF_MOBILITY)})
    errors = ErrorCollector()
    rows = written.rows(written.names(node), schema).values()
    settings = read_struct("radio", rows, SettingReader(), errors, f"{node}.")
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
