from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.resolve.runs import (
    FileHashes,
    UnreadVariables,
    select_runs,
    text_of_files,
    text_of_runs,
)
from python.scenario.conftest import BASE


def error_at(folder: Any, added: str) -> ConfigError:
    """Return the error of the base with additional lines, which start at line 6."""
    with pytest.raises(ConfigError) as error:
        folder.load(added)
    return error.value


def test_a_constraint_chooses_combinations_and_numbers_close_up(folder: Any) -> None:
    folder.load(
        "*.uavs[*].mobility.speed = ${speed=1..3}mps\n*.uavs[*].protocol.retries = ${n=1..3}\n"
        "constraint = $n < $speed\n"
    )
    scenarios = load_scenarios(folder.ini)
    assert [scenario.run_number for scenario in scenarios] == [0, 1, 2]
    assert [tuple(scenario.iterations.values()) for scenario in scenarios] == [
        ("2", "1"),
        ("3", "1"),
        ("3", "2"),
    ]


def test_a_constraint_that_leaves_nothing(folder: Any) -> None:
    added = "*.uavs[*].mobility.speed = ${speed=1..3}mps\nconstraint = $speed > 3\n"
    assert error_at(folder, added).key == "constraint"


def test_repeat_is_the_same_for_all_combinations(folder: Any) -> None:
    assert error_at(folder, "repeat = ${1, 2}\n").key == "repeat"


def test_there_is_a_limit_to_the_number_of_runs(folder: Any) -> None:
    assert error_at(folder, "repeat = 1000\n**.speed = ${1..2000}mps\n").line == 6


def test_a_run_beyond_all_combinations_says_how_many_there_are(folder: Any) -> None:
    folder.load("repeat = 3\n**.speed = ${1, 2}mps\n")
    with pytest.raises(ConfigError) as error:
        load_scenarios(folder.ini, runs=[6])
    assert "0 to 5" in error.value.expected


def values_of(folder: Any, added: str) -> list[tuple[tuple[str, ...], int]]:
    """Return the values of the iteration variables, and the repetition, for each run."""
    folder.load(added)
    return [(tuple(each.iterations.values()), each.repetition) for each in load_scenarios(folder.ini)]


SPEED_AND_N = (
    "*.uavs[*].mobility.speed = ${speed=1,2}mps\n*.uavs[*].protocol.retries = ${n=3,4}\nrepeat = 2\n"
)


def test_the_first_variable_is_the_outermost_and_repetitions_are_the_innermost(folder: Any) -> None:
    assert values_of(folder, SPEED_AND_N)[:4] == [
        (("1", "3"), 0),
        (("1", "3"), 1),
        (("1", "4"), 0),
        (("1", "4"), 1),
    ]


@pytest.mark.parametrize(
    ("order", "runs"),
    [
        ("repetition, n", [(("3", "1"), 0), (("3", "2"), 0), (("4", "1"), 0)]),
        ("*, speed", [(("3", "1"), 0), (("3", "2"), 0), (("3", "1"), 1)]),
        ("n", [(("3", "1"), 0), (("3", "1"), 1), (("3", "2"), 0)]),
        ("repetition, *", [(("1", "3"), 0), (("1", "4"), 0), (("2", "3"), 0)]),
        ('"n,*,repetition"', [(("3", "1"), 0), (("3", "1"), 1), (("3", "2"), 0)]),
    ],
)
def test_another_nesting_order(folder: Any, order: str, runs: list[tuple[tuple[str, str], int]]) -> None:
    assert values_of(folder, f"{SPEED_AND_N}iteration-nesting-order = {order}\n")[:3] == runs


@pytest.mark.parametrize("order", ["m", "speeed", "n, n", "*, n, *"])
def test_a_wrong_nesting_order(folder: Any, order: str) -> None:
    error = error_at(folder, f"{SPEED_AND_N}iteration-nesting-order = {order}\n")
    assert error.key == "iteration-nesting-order"


def test_a_variable_may_be_in_lock_step_with_the_repetitions(folder: Any) -> None:
    added = "*.uavs[*].mobility.speed = ${speed=5, 6, 7 ! repetition}mps\nrepeat = 3\n"
    assert values_of(folder, added) == [(("5",), 0), (("6",), 1), (("7",), 2)]


def test_a_constraint_may_ask_for_the_repetition(folder: Any) -> None:
    added = f"{SPEED_AND_N}constraint = $repetition < $speed\n"
    assert [repetition for _, repetition in values_of(folder, added)] == [0, 0, 0, 1, 0, 1]


def test_a_run_beyond_what_the_constraint_leaves(folder: Any) -> None:
    folder.load(f"{SPEED_AND_N}constraint = $n == 3\n")
    with pytest.raises(ConfigError) as error:
        load_scenarios(folder.ini, runs=[4])
    assert "0 to 3" in error.value.expected


SOURCE = Source(Path("a.ini"), 3)


@pytest.mark.parametrize(
    ("runs", "expected"),
    [
        (None, [0, 1, 2, 3, 4]),
        ("0", [0]),
        ("3,1", [1, 3]),
        ("1..3", [1, 2, 3]),
        ("1-3", [1, 2, 3]),
        (" 0 , 2 .. 4 ", [0, 2, 3, 4]),
        ("2,1..3", [1, 2, 3]),
        ([4, 0, 4], [0, 4]),
    ],
)
def test_selects(runs: str | list[int] | None, expected: list[int]) -> None:
    assert list(select_runs(runs, 5, "X", SOURCE)) == expected


@pytest.mark.parametrize("runs", ["", "a", "1,,2", "3..1", "-1", "1.5"])
def test_texts_that_are_no_runs(runs: str) -> None:
    with pytest.raises(ConfigError):
        select_runs(runs, 5, "X", SOURCE)


@pytest.mark.parametrize("runs", [3, [0.5], ["0"]])
def test_what_are_no_numbers_of_runs(runs: Any) -> None:
    with pytest.raises(TypeError):
        select_runs(runs, 5, "X", SOURCE)


@pytest.mark.parametrize("runs", ["5", "2..7", [-1], "0..999999999"])
def test_runs_that_do_not_exist(runs: str | list[int]) -> None:
    with pytest.raises(ConfigError) as error:
        select_runs(runs, 5, "X", SOURCE)
    assert error.value.line == 3


@pytest.mark.parametrize(
    ("numbers", "text"), [([3], "3"), ([0, 1], "0..1"), ([0, 2, 5, 6, 7, 9], "0,2,5..7,9")]
)
def test_the_text_of_runs(numbers: list[int], text: str) -> None:
    assert text_of_runs(numbers) == text


@given(st.sets(st.integers(0, 30), min_size=1))
def test_the_text_of_runs_selects_them(numbers: set[int]) -> None:
    assert select_runs(text_of_runs(sorted(numbers)), 31, "X", SOURCE) == sorted(numbers)


@pytest.mark.parametrize("wrong", ["3", 3.0])
def test_a_seed_that_is_no_whole_number(folder: Any, wrong: Any) -> None:
    scenario = folder.load("")
    with pytest.raises(TypeError):
        load_scenarios(folder.ini, seed=wrong)
    with pytest.raises(TypeError):
        replace(scenario, seed=wrong)


@pytest.mark.parametrize("wrong", [-1, 2**63])
def test_a_seed_that_is_out_of_range(folder: Any, wrong: int) -> None:
    scenario = folder.load("")
    with pytest.raises(ValueError, match=r"^seed = "):
        load_scenarios(folder.ini, seed=wrong)
    with pytest.raises(ValueError, match=r"^seed = "):
        replace(scenario, seed=wrong)


def hash_of(folder: Any, added: str = "", *overrides: str) -> str:
    text: str = folder.load(added, "General", *overrides).settings_hash
    return text


def test_it_is_that_of_the_same_settings(folder: Any) -> None:
    assert hash_of(folder, "# a comment\n\n**.speed   =  3mps\n") == hash_of(folder, "**.speed = 3mps\n")


@pytest.mark.parametrize(
    "other", [[], ["**.speed=4mps"], ['**.label="3mps"'], ["sim-time-limit=5s", "**.speed=3mps"]]
)
def test_other_settings_have_another(folder: Any, other: list[str]) -> None:
    assert hash_of(folder, "", *other) != hash_of(folder, "", "**.speed=3mps")


def test_the_same_value_of_another_key_has_another(folder: Any) -> None:
    assert hash_of(folder, "", "**.initialX=3m") != hash_of(folder, "", "**.initialY=3m")


@pytest.mark.parametrize(
    "added",
    [
        "repeat = 3\n",
        "description = again\n",
        "network = Network\n",
        "*.visualizer.x = 3\n",
        "constraint = 1 < 2\n",
        "iteration-nesting-order = *\n",
    ],
)
def test_what_no_run_depends_on_does_not_count(folder: Any, added: str) -> None:
    assert hash_of(folder, added) == hash_of(folder)


def test_an_overridden_line_does_not_count(folder: Any) -> None:
    assert hash_of(folder, "**.speed = 4mps\n", "**.speed=3mps") == hash_of(folder, "", "**.speed=3mps")


def test_runs_of_different_values_have_different_ones(folder: Any) -> None:
    folder.load("repeat = 2\n**.speed = ${3, 4}mps\n")
    first, again, other, _ = (scenario.settings_hash for scenario in load_scenarios(folder.ini))
    assert first == again != other


def test_repetitions_with_values_of_their_own_have_different_ones(folder: Any) -> None:
    folder.load("repeat = 2\n**.speed = ${3, 4 ! repetition}mps\n")
    assert len({scenario.settings_hash for scenario in load_scenarios(folder.ini)}) == 2


def test_repetitions_have_the_same_whatever_depends_on_their_number(folder: Any) -> None:
    folder.load('repeat = 2\nseed-set = ${repetition}\n**.label = "${runnumber}"\n')
    first, again = (scenario.settings_hash for scenario in load_scenarios(folder.ini))
    assert first == again


def test_repetitions_have_the_same_whatever_label_depends_on_their_number(folder: Any) -> None:
    labels = 'measurement-label = "m ${seedset}"\nreplication-label = "r" + string(${runnumber})\n'
    folder.load(f'repeat = 2\n{labels}**.label = "${{measurement}} ${{replication}}"\n')
    first, again = (scenario.settings_hash for scenario in load_scenarios(folder.ini))
    assert first == again


@pytest.mark.parametrize("name", ["experiment", "measurement", "replication"])
def test_another_label_is_another_setting_if_a_value_names_it(folder: Any, name: str) -> None:
    added = f'**.label = "${{{name}}}"\n'
    assert hash_of(folder, added, f"{name}-label=a") != hash_of(folder, added, f"{name}-label=b")


def test_another_label_is_none_if_no_value_names_it(folder: Any) -> None:
    assert hash_of(folder, "", "replication-label=a") == hash_of(folder, "", "replication-label=b")


def test_names_are_seen_from_the_folder(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    for name in ("b.py", "a/c.py"):
        (tmp_path / name).write_text("")
    found = FileHashes(tmp_path / "a").of([tmp_path / "b.py", tmp_path / "a" / "c.py"])
    assert list(found) == ["../b.py", "c.py"]


def test_equal_content_has_an_equal_hash(tmp_path: Path) -> None:
    for name, text in (("a", "1"), ("b", "1"), ("c", "2")):
        (tmp_path / name).write_text(text)
    found = FileHashes(tmp_path).of(tmp_path / name for name in "abc")
    assert found["a"] == found["b"] != found["c"]
    assert len(found["a"]) == 16


def test_a_file_that_cannot_be_read_has_none(tmp_path: Path) -> None:
    assert FileHashes(tmp_path).of([tmp_path / "gone"]) == {"gone": ""}


def test_a_name_that_no_file_can_have_has_none(tmp_path: Path) -> None:
    assert FileHashes(tmp_path).of([tmp_path / ("a" * 300)]) == {"a" * 300: ""}


def test_what_is_no_regular_file_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "null").symlink_to("/dev/null")
    assert list(FileHashes(tmp_path).of([tmp_path / "null"]).values()) == [""]


@pytest.mark.parametrize(
    ("names", "text"),
    [("a", "a"), ("ab", "a and b"), ("abcd", "a and b and c and d"), ("abcde", "a, b, c and 2 other files")],
)
def test_of_many_files_the_first_ones_are_named(names: str, text: str) -> None:
    assert text_of_files(tuple(names)) == text


def load(folder: Path, *lines: str) -> Scenario:
    (folder / "a.py").write_text("from helper import Quiet\nclass A(Quiet): pass\n")
    (folder / "helper.py").write_text("from python.quiet_protocol import QUIET\nexec(QUIET)\n")
    crs = '{"type": "name", "properties": {"name": "local"}}'
    (folder / "map.geojson").write_text(f'{{"type": "FeatureCollection", "features": [], "crs": {crs}}}')
    (folder / "rates.csv").write_text("1\n")
    text = 'sim-time-limit = 1s\n*.node.protocol.class = "a.py:A"\n'
    (folder / "test.ini").write_text(text + "".join(f"{line}\n" for line in lines))
    (scenario,) = load_scenarios(folder / "test.ini")
    return scenario


def test_files_whose_names_depend_on_an_index_count(tmp_path: Path) -> None:
    errors = "*.node.wlan[*].radio.receiver.errorModel"
    model = f'{errors}.typename = "Ieee80211BerTableErrorModel"'
    file = f'{errors}.berTableFile = choose(ancestorIndex(3), "rates.csv others.csv")'
    assert load(tmp_path, model, file).file_hashes.keys() == {"a.py", "helper.py", "rates.csv"}


def test_protocols_count_with_what_they_import(tmp_path: Path) -> None:
    assert load(tmp_path).file_hashes.keys() == {"a.py", "helper.py"}


def test_other_files_that_settings_name_count(tmp_path: Path) -> None:
    scenario = load(
        tmp_path,
        '*.environment.obstacles = "map.geojson"',
        '*.node.wlan[*].radio.receiver.errorModel.berTableFile = "rates.csv"',
    )
    assert scenario.file_hashes.keys() == {"a.py", "helper.py", "map.geojson", "rates.csv"}


def test_a_native_protocol_is_of_the_engine(tmp_path: Path) -> None:
    pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")
    scenario = load(tmp_path, '*.other.protocol.typename = "SinkProtocol"')
    assert scenario.file_hashes.keys() == {"a.py", "gradysim/_netsim", "helper.py"}
    assert scenario.file_hashes["gradysim/_netsim"]


def test_a_protocol_that_is_named_as_a_module(tmp_path: Path) -> None:
    (tmp_path / "test.ini").write_text(
        'sim-time-limit = 1s\n*.node.protocol.class = "python.quiet_protocol:Quiet"\n'
    )
    (scenario,) = load_scenarios(tmp_path / "test.ini")
    assert [name.rpartition("/")[2] for name in scenario.file_hashes] == ["quiet_protocol.py"]


RTS = "**.rtsThreshold = ${rts=3000B, 100B}\n"
IN_FULL = "**.mac.dcf.rtsPolicy.rtsThreshold=100B"
BOATS = '**.boats[*].protocol.class = "protocols.py:Sensor"\n'


def unread(folder: Any, added: str, *overrides: str, runs: str | None = None) -> list[UnreadVariables]:
    """Return the unread variables of the base with additional lines; they are the same for each run."""
    folder.write("test.ini", BASE + added)
    first, *others = load_scenarios(folder.ini, runs=runs, overrides=overrides)
    assert all(other.unread_variables == first.unread_variables for other in others)
    return list(first.unread_variables)


@pytest.mark.parametrize(
    ("study", "override"),
    [
        ("**.rtsThreshold = ${v=3000B, 100B}", IN_FULL),
        ("*.uavs[1].mobility.speed = ${v=1, 2}mps", "*.uavs[*].mobility.speed=3mps"),
        ("*.radioMedium.backgroundNoise.power = ${v=-90, -80}dBm", "*.radioMedium.**.power=-86dBm"),
        ("*.uavs[*].protocol.retries = ${v=1, 2}", "**.retries=3"),
    ],
)
def test_a_study_that_another_key_overrides(folder: Any, study: str, override: str) -> None:
    (variables,) = unread(folder, f"{study}\n", override)
    assert (variables.source.line, variables.names) == (6, ("v",))
    assert variables.instead is not None
    assert f"{variables.instead.key}={variables.instead.value}" == override


def test_the_line_in_force_is_told_from_lines_about_other_things(folder: Any) -> None:
    study = "*.uavs[1].mobility.speed = ${v=1, 2}mps\n"
    (variables,) = unread(folder, study, "**.bitrate=2Mbps", "*.uavs[*].mobility.speed=3mps")
    assert variables.instead is not None
    assert variables.instead.key == "*.uavs[*].mobility.speed"


@pytest.mark.parametrize(
    ("study", "override"),
    [
        (f"*.numBoats = ${{v=1, 2}}\n{BOATS}", "*.boats.count=1"),
        ("*.uavs[*].mobility.initialX = ${v=1m, 2m}\n", "*.uavs[*].mobility.lineStartX=5m"),
        ("*.uavs[*].mobility.lineStepX = ${v=1m, 2m}\n", "**.initialX=5m"),
        ("*.uavs[*].mobility.separationX = ${v=1m, 2m}\n", "**.initialX=5m"),
        ("*.uavs[*].mobility.initialX = ${v=1m, 2m}\n", "**.uavs[*].mobility.separationX=5m"),
        ("**.channelNumber = ${v=1, 5}\n", "**.centerFrequency=2.422GHz"),
        ("*.uavs[*].mobility.speed = ${v=1, 2}mps\n", "**.mobility.speed=default"),
    ],
)
def test_a_study_that_a_key_for_the_same_thing_overrides(folder: Any, study: str, override: str) -> None:
    (variables,) = unread(folder, study, override)
    assert (variables.source.line, variables.names) == (6, ("v",))


@pytest.mark.parametrize(
    "lines",
    [
        "**.power = ${p=1mW, 2mW}\n",
        "*.uavs[*].mobility.lineStepX = ${v=1m, 2m}\n",
        "*.uavs[*].mobility.separationX = ${v=1m, 2m}\n*.uavs[*].mobility.initialY = ${w=1m, 2m}\n",
        "description = ${text=one, two}\n",
        f"*.numBoats = ${{n=0, 1}}\n{BOATS}**.boats[*].mobility.speed = ${{v=1, 2}}mps\n",
        f"*.numBoats = ${{n=0, 1}}\n{BOATS}*.boats[0].mobility.speed = ${{v=1, 2}}mps\n",
    ],
)
def test_what_some_run_reads(folder: Any, lines: str) -> None:
    assert unread(folder, lines) == []


@pytest.mark.parametrize(
    "line",
    [
        "**.retries = ${rts} > 100B ? 1 : 2",
        "*.uavs[*].mobility.speed = ${v=1, 2 ! rts}mps",
        "**.label = ${iterationvars}",
        "seed-set = ${rts} > 100B ? 1 : 2",
    ],
)
def test_a_variable_that_another_line_refers_to_makes_runs_differ(folder: Any, line: str) -> None:
    assert unread(folder, RTS + f"{line}\n".replace("${iterationvars}", '"${iterationvars}"'), IN_FULL) == []


@pytest.mark.parametrize(
    "line",
    [
        "constraint = $rts > 0B",
        "iteration-nesting-order = rts",
        "experiment-label = ${rts}",
        "**.sigma = ${rts} > 0B ? 1 : 2\n**.pathLoss.sigma = 1",
    ],
)
def test_a_line_that_nothing_in_a_run_follows_from_does_not(folder: Any, line: str) -> None:
    override = (IN_FULL, "*.radioMedium.pathLoss.sigma=3") if "sigma" in line else (IN_FULL,)
    (variables,) = unread(folder, f"{RTS}{line}\n", *override)
    assert variables.names == ("rts",)


def test_an_override_with_the_same_key_leaves_no_variable(folder: Any) -> None:
    assert unread(folder, RTS, "**.rtsThreshold=100B") == []


def test_a_single_value_makes_no_runs_that_are_alike(folder: Any) -> None:
    assert unread(folder, "**.rtsThreshold = ${rts=3000B}\n", IN_FULL) == []


def test_several_variables_of_a_line_are_told_together(folder: Any) -> None:
    (variables,) = unread(folder, "**.rtsThreshold = ${a=1, 2}B * ${2, 3}\n", IN_FULL)
    assert variables.names == ("a", "0")


def test_of_some_of_the_runs_nothing_is_said(folder: Any) -> None:
    assert unread(folder, RTS, IN_FULL, runs="0") == []
