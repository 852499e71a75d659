from pathlib import Path

import pytest

from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.runs import FileHashes, text_of_files


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
