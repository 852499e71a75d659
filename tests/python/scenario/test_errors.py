import pickle
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import (
    ArgumentNames,
    BadValue,
    ConfigError,
    ConfigErrors,
    ErrorCollector,
    Source,
    did_you_mean,
    is_fully_qualified,
    nearest,
    nearest_file,
)

SOURCE = Source(Path("a.ini"), 7, "*.x.mobility.speed", "-1mps")
NAMES = ["sim-time-limit", "seed-set", "repeat", "heartbeat_jitter"]


def test_an_error_has_place_and_parts() -> None:
    error = ConfigError("wrong", SOURCE, expected="another", suggestion="thong", hint="; see x")
    assert str(error) == "a.ini:7: wrong; expected another; did you mean `thong`?; see x"
    assert (error.file, error.line, error.key, error.value) == (
        Path("a.ini"),
        7,
        "*.x.mobility.speed",
        "-1mps",
    )
    assert (error.problem, error.expected, error.suggestion) == ("wrong", "another", "thong")


def test_an_error_may_have_no_place() -> None:
    error = ConfigError("runs = x: wrong")
    assert str(error) == "runs = x: wrong"
    assert (error.source, error.file, error.line, error.key, error.value) == (None, None, 0, "", "")


def test_at_adds_key_and_value() -> None:
    assert str(ConfigError.at(SOURCE, "wrong")) == "a.ini:7: *.x.mobility.speed = -1mps: wrong"


def test_at_does_not_repeat_an_override() -> None:
    source = Source(Path("a.ini"), 0, "repeat", "0", "--set")
    assert str(ConfigError.at(source, "wrong")) == "--set repeat=0: wrong"


@pytest.mark.parametrize(
    ("name", "lines"),
    [("a.ini", [0, 1, 2]), ("passwords", [0, 1]), ("link.ini", [0, 1]), ("no\0file", [0, 1])],
)
def test_of_other_files_than_ini_one_error_is_told(tmp_path: Path, name: str, lines: list[int]) -> None:
    (tmp_path / "link.ini").symlink_to("passwords")
    file = tmp_path / name
    sources = [Source(file, 0, "key", "value", "--set"), Source(file, 1), Source(file, 2)]
    error = ConfigErrors(ConfigError("wrong", source) for source in reversed(sources))
    assert [each.line for each in error.errors] == lines


def test_long_values_are_shortened() -> None:
    source = Source(Path("a.ini"), 7, "*.x.points", "1" * 5000)
    assert str(ConfigError.at(source, "wrong")) == f"a.ini:7: *.x.points = {'1' * 100}…: wrong"
    error = ConfigError(f"that is {'1' * 100_000}: out of range; expected {'a' * 799}", SOURCE)
    assert str(error) == f"a.ini:7: that is {'1' * 100}… out of range; expected {'a' * 799}"
    override = Source(Path("a.ini"), 0, "*.x.points", "1 " * 500, "--set")
    assert str(override) == f"--set *.x.points={'1 ' * 50}…"


def test_errors_survive_pickling() -> None:
    error = ConfigError("wrong", SOURCE, expected="right", suggestion="left", hint="; up")
    copy = pickle.loads(pickle.dumps(error))
    assert (str(copy), vars(copy)) == (str(error), vars(error))
    several = pickle.loads(pickle.dumps(ConfigErrors([error])))
    assert [vars(each) for each in several.errors] == [vars(error)]


def test_several_errors_are_sorted_by_line_and_given_once() -> None:
    late, early = (ConfigError("wrong", Source(Path("a.ini"), line, f"k{line}")) for line in (12, 3))
    override = ConfigError("wrong", Source(Path("a.ini"), 0, "repeat", "0", "--set"))
    errors = ConfigErrors([late, early, override, early])
    assert errors.errors == [override, early, late]
    assert (errors.line, errors.key) == (0, "repeat")
    assert str(errors).splitlines() == [str(override), str(early), str(late)]


def test_a_bad_value_becomes_the_error_of_a_place() -> None:
    bad = BadValue("no unit `sec`", "; see `gradysim keys`", suggestion="s")
    assert (str(bad), bad.problem) == (
        "no unit `sec`; did you mean `s`?; see `gradysim keys`",
        "no unit `sec`",
    )
    error = bad.at(SOURCE, prefix="that is 5: ", expected="a speed")
    assert (error.line, error.expected, error.suggestion) == (7, "a speed", "s")
    assert error.problem == "*.x.mobility.speed = -1mps: that is 5: no unit `sec`"
    assert BadValue("no", expected="a time").at(SOURCE, expected="a speed").expected == "a time"


def test_places_of_lines_overrides_and_files() -> None:
    assert str(Source(Path("configs/a.ini"), 7, "repeat", "0")) == "configs/a.ini:7"
    override = Source(Path("a.ini"), 0, "repeat", "0", "--set")
    assert (override.is_override, str(override)) == (True, "--set repeat=0")
    file = Source(Path("a.ini"), 0)
    assert (file.is_override, str(file)) == (False, "a.ini")


NO_SUCH = {"overrides": ["*.numUavs=two"], "seed": -1, "runs": "x"}


@pytest.mark.parametrize(
    ("argument", "beginning"),
    [("overrides", "override *.numUavs=two: "), ("seed", "seed = -1: "), ("runs", "runs = x: ")],
)
def test_messages_call_arguments_as_scripts_do(folder: Any, argument: str, beginning: str) -> None:
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini, **{argument: NO_SUCH[argument]})
    assert str(caught.value).startswith(beginning)


@pytest.mark.parametrize(
    ("argument", "beginning"),
    [("overrides", "-o *.numUavs=two: "), ("seed", "-s -1: "), ("runs", "-n x: ")],
)
def test_messages_call_arguments_as_the_caller_does(folder: Any, argument: str, beginning: str) -> None:
    names = ArgumentNames("-o", "-s", "-n", "-c")
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini, **{argument: NO_SUCH[argument]}, names=names)
    assert str(caught.value).startswith(beginning)


def test_a_message_lists_other_configurations(folder: Any) -> None:
    folder.write("test.ini", "sim-time-limit = 1s\n[X]\n*.uavs.count = 2\n")
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini)
    assert str(caught.value).endswith("`config = NAME`, X")


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("sim-time-limt", "sim-time-limit"),
        ("Repeat", "repeat"),
        ("jitter", "heartbeat_jitter"),
        ("zzz", ""),
        ("e", ""),
    ],
)
def test_nearest_name(name: str, expected: str) -> None:
    assert nearest(name, NAMES) == expected


@pytest.mark.parametrize(("name", "expected"), [("mw", "mW"), ("Mw", "MW"), ("mW", "mW")])
@pytest.mark.parametrize("names", [["MW", "mW"], ["mW", "MW"]])
def test_case_decides_between_names_that_are_otherwise_equal(
    name: str, expected: str, names: list[str]
) -> None:
    assert nearest(name, names) == expected


def test_a_part_of_several_names_is_near_to_none_of_them() -> None:
    assert nearest("time", ["a-long-name-with-time-in-it", "another-long-name-with-time"]) == ""


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("materail", "material"),
        ("Material", "material"),
        ("matrial", "material"),
        ("hieght", "height"),
        ("hight", "height"),
        ("relative_permittivity", "relativePermittivity"),
        ("relativePermitivity", "relativePermittivity"),
        ("bse", "base"),
        ("case", ""),
        ("min_height", ""),
        ("building:material", ""),
        ("building:levels", ""),
        ("basement", ""),
        ("relative", ""),
        ("", ""),
    ],
)
def test_strictly_nearest_is_a_typing_error_away(name: str, expected: str) -> None:
    assert nearest(name, ["height", "base", "material", "relativePermittivity"], strict=True) == expected


def test_did_you_mean_ends_a_message() -> None:
    assert did_you_mean("seedset", NAMES) == "; did you mean `seed-set`?"
    assert did_you_mean("zzz", NAMES) == ""


@pytest.fixture
def protocols(tmp_path: Path) -> Path:
    for name in ("relay.py", "r9.py", "sensor.py", "relays.txt"):
        (tmp_path / name).touch()
    return tmp_path


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("realy.py", "relay.py"),
        ("relay", "relay.py"),
        ("relays.py", "relay.py"),
        ("a.py", ""),
        ("hello.py", ""),
    ],
)
def test_files_are_compared_without_suffix(protocols: Path, name: str, expected: str) -> None:
    assert nearest_file(protocols / name, (".py",)) == expected


def test_files_may_have_several_suffixes(protocols: Path) -> None:
    assert nearest_file(protocols / "relys.txt", (".py", ".txt")) == "relays.txt"


def test_the_directory_is_as_the_user_wrote_it(protocols: Path) -> None:
    assert nearest_file(protocols / "realy.py", (".py",), "../protocols/realy.py") == "../protocols/relay.py"


@pytest.mark.parametrize("directory", ["nowhere", "n" * 5000, "n\0"])
def test_a_directory_that_does_not_exist_has_no_files(tmp_path: Path, directory: str) -> None:
    assert nearest_file(tmp_path / directory / "missing.ini", (".ini",)) == ""


@pytest.mark.parametrize(
    "key",
    [
        "*.uavs[*].mobility.speed",
        "*.uavs[0..3].mobility.speed",
        "*.{u,q}avs[*].mobility.speed",
        "Network.uavs[0].mobility.speed",
        "**.mobility.speed",
        "**[0].mobility.speed",
    ],
)
def test_a_key_with_all_names_after_its_wildcards_is_fully_qualified(key: str) -> None:
    assert is_fully_qualified(key, "mobility.speed")


@pytest.mark.parametrize(
    "key", ["**", "**.speed", "**.*speed", "**.*.speed", "*.*.*.speed", "**.mobility.s*"]
)
def test_a_key_with_a_wildcard_for_a_name_is_not_fully_qualified(key: str) -> None:
    assert not is_fully_qualified(key, "mobility.speed")


@pytest.mark.parametrize(
    ("key", "expected"),
    [
        ("**.power", False),
        ("**.transmitter.power", False),
        ("**.wlan[*].radio.transmitter.power", True),
        ("**.wlan[..3].radio.transmitter.power", True),
    ],
)
def test_indices_do_not_count_as_names(key: str, expected: bool) -> None:
    assert is_fully_qualified(key, "wlan[1].radio.transmitter.power") == expected


@pytest.mark.parametrize("part", ["problem", "expected", "suggestion", "hint"])
def test_no_error_is_longer_than_a_thousand_characters(part: str) -> None:
    words = {"problem": "wrong", "expected": "right", "suggestion": "left", "hint": "; up"}
    source = replace(SOURCE, key="k" * 2000, value="v " * 2000)
    for long in ("x" * 5000, "x " * 5000, "`x ` " * 5000, f"`{'x ' * 5000}`"):
        arguments = words | {part: long}
        for error in (
            ConfigError(arguments.pop("problem"), source, **arguments),
            ConfigError.at(source, long, **arguments),
        ):
            assert len(str(error)) <= 1000


def test_reading_stops_at_a_hundred_errors() -> None:
    errors = ErrorCollector()
    lines = (ConfigError("wrong", replace(SOURCE, line=line)) for line in range(1, 1000))
    with pytest.raises(ConfigErrors) as caught:
        list(map(errors.add, lines))
    assert [error.line for error in caught.value.errors] == list(range(1, 101))
    outer = ErrorCollector()
    outer.errors = caught.value.errors[:60]
    with pytest.raises(ConfigErrors) as again, outer.collecting():
        raise caught.value
    assert len(again.value.errors) == 100
