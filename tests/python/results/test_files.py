import dataclasses
import errno
import json
import pathlib
from hashlib import sha256

import pytest

from gradysim.results.files import (
    files_changed_since,
    has_written,
    is_run_file,
    read_run_file,
    run_name,
    write_run_file,
)
from gradysim.results.result import NodeResult, RunResult
from gradysim.results.result_hash import result_hash

EARLIER = pathlib.Path(__file__).with_name("earlier_names")
"""A result that was written when outcomes were called fates."""

RESULT = RunResult("ZigZag5", 3, 3, "integrated", 1.0, 0.1, 0.1, 10, False, "0123456789abcdef", {}, ())


def test_name_of_the_file(tmp_path):
    assert write_run_file(RESULT, tmp_path) == tmp_path / f"ZigZag5-#3.{RESULT.mode}.json"


@pytest.mark.parametrize(("count", "name"), [(1, ""), (4, "General-#3.integrated")])
def test_one_of_several_runs_has_a_name_for_files(make_scenario, count, name):
    scenario = dataclasses.replace(make_scenario(), run_number=3, run_count=count)
    assert run_name(scenario, "integrated") == name


def test_content_is_the_json_object(tmp_path):
    path = write_run_file(RESULT, tmp_path)
    content = json.loads(path.read_text(encoding="utf-8"))
    assert content == {**RESULT.to_json_object(), "output_hashes": {}, "checksum": content["checksum"]}
    assert read_run_file(path) == content


def test_a_changed_digit_is_noticed_wherever_it_is(tmp_path):
    path = write_run_file(dataclasses.replace(RESULT, wall_s=0.30000000000000004), tmp_path)
    text = path.read_text(encoding="utf-8")
    digits = [place for place, letter in enumerate(text) if letter.isdigit()]
    assert len(digits) > 40
    for place in digits:
        other = str(9 - int(text[place]))
        path.write_text(text[:place] + other + text[place + 1 :], encoding="utf-8")
        with pytest.raises(ValueError, match=r"checksum|delimiter"):
            read_run_file(path)


def test_a_file_without_a_checksum_is_taken_as_it_is(tmp_path):
    path = tmp_path / "old.json"
    path.write_text('{"run": 3}')
    assert read_run_file(path) == {"run": 3}


@pytest.mark.parametrize(
    ("name", "is_result"),
    [
        ("A-#0.integrated.json", True),
        ("A.b-#12.prototype.json", True),
        ("A-#0.json", False),
        ("a.json", False),
    ],
)
def test_result_files_are_known_by_their_names(name, is_result):
    assert is_run_file(name) == is_result


def test_it_names_the_other_files_of_the_run(tmp_path):
    (tmp_path / "a.pcap").write_bytes(b"frames")
    path = write_run_file(RESULT, tmp_path, [tmp_path / "a.pcap"])
    hashes = json.loads(path.read_text(encoding="utf-8"))["output_hashes"]
    assert hashes == {"a.pcap": sha256(b"frames").hexdigest()[:16]}


def test_another_file_of_the_run_that_cannot_be_read_is_an_error(tmp_path):
    missing = tmp_path / "missing.pcap"
    with pytest.raises(OSError, match=r"missing\.pcap") as raised:
        write_run_file(RESULT, tmp_path, [missing])
    assert raised.value.filename == str(missing)
    assert list(tmp_path.iterdir()) == []


def test_a_missing_directory_is_made(tmp_path):
    assert write_run_file(RESULT, tmp_path / "a" / "b").is_file()


def test_an_earlier_file_of_the_run_is_replaced(tmp_path):
    write_run_file(RESULT, tmp_path)
    path = write_run_file(dataclasses.replace(RESULT, events=11), tmp_path)
    assert json.loads(path.read_text(encoding="utf-8"))["events"] == 11


def test_a_disk_that_is_full_does_not_cost_the_earlier_file(tmp_path, monkeypatch):
    earlier = write_run_file(RESULT, tmp_path).read_text(encoding="utf-8")

    def write_half(path, text, **_):
        with path.open("w", encoding="utf-8") as file:
            file.write(text[: len(text) // 2])
        raise OSError(errno.ENOSPC, "spoilt")

    with monkeypatch.context() as patch:
        patch.setattr(pathlib.Path, "write_text", write_half)
        with pytest.raises(OSError, match="spoilt") as raised:
            write_run_file(dataclasses.replace(RESULT, events=11), tmp_path)
    (path,) = tmp_path.iterdir()
    assert path.read_text(encoding="utf-8") == earlier
    assert raised.value.filename == str(path)


def test_a_folder_that_is_read_only_is_an_error_about_the_file(tmp_path, monkeypatch):
    def refuse(path, *_, **__):
        raise OSError(errno.EROFS, "read-only file system", str(path))

    with monkeypatch.context() as patch:
        patch.setattr(pathlib.Path, "write_text", refuse)
        patch.setattr(pathlib.Path, "unlink", refuse)
        with pytest.raises(OSError, match="read-only") as raised:
            write_run_file(RESULT, tmp_path)
    assert pathlib.Path(raised.value.filename).name == "ZigZag5-#3.integrated.json"


def test_a_directory_that_cannot_be_made_is_an_error(tmp_path):
    (tmp_path / "taken").write_text("")
    with pytest.raises(OSError, match="taken"):
        write_run_file(RESULT, tmp_path / "taken")


def is_done(scenario, mode, folder, outcomes_at=()):
    return files_changed_since(scenario, mode, folder, outcomes_at) == ()


@pytest.fixture
def done(make_scenario, tmp_path):
    """Return a scenario and a directory with its result."""
    scenario = make_scenario()
    result = dataclasses.replace(
        RESULT,
        config=scenario.config,
        run=scenario.run_number,
        seed=scenario.seed,
        settings_hash=scenario.settings_hash,
        file_hashes=scenario.file_hashes,
    )
    return scenario, result, tmp_path / "results"


def test_a_run_is_done_if_its_file_is_there(done):
    scenario, result, folder = done
    assert not is_done(scenario, "integrated", folder)
    write_run_file(result, folder)
    assert is_done(scenario, "integrated", folder)
    assert not is_done(scenario, "prototype", folder)


@pytest.mark.parametrize(
    "change",
    [
        {"interrupted": True},
        {"seed": 99},
        {"settings_hash": "another"},
        {"run": 1},
        {"repetition": 1},
        {"iterations": {"x": "2"}},
    ],
)
def test_a_run_is_not_done_by_another_result(done, change):
    scenario, result, folder = done
    write_run_file(dataclasses.replace(result, **change), folder)
    assert not is_done(scenario, "integrated", folder)


@pytest.mark.parametrize(
    ("hashes", "changed"),
    [
        ({"a.py": "1", "b.py": "2"}, ()),
        ({"a.py": "1", "b.py": "3"}, ("b.py",)),
        ({"a.py": "1"}, ("b.py",)),
        ({"a.py": "1", "b.py": "2", "c.py": "3"}, ("c.py",)),
        ({}, ("a.py", "b.py")),
    ],
)
def test_a_result_is_older_than_files_that_differ(done, hashes, changed):
    scenario, result, folder = done
    scenario = dataclasses.replace(scenario, file_hashes={"a.py": "1", "b.py": "2"})
    write_run_file(dataclasses.replace(result, file_hashes=hashes), folder)
    assert files_changed_since(scenario, "integrated", folder) == changed


def test_a_result_that_is_none_of_this_run_is_not_older(done):
    scenario, result, folder = done
    write_run_file(dataclasses.replace(result, seed=99), folder)
    assert files_changed_since(scenario, "integrated", folder) is None


def test_the_values_of_a_run_that_is_done_may_be_numbers_and_texts(done):
    scenario, result, folder = done
    iterations = {"x": "0.1", "y": '"a"', "z": "5m"}
    write_run_file(dataclasses.replace(result, iterations=iterations), folder)
    assert is_done(dataclasses.replace(scenario, iterations=iterations), "integrated", folder)


def test_a_result_without_the_outcomes_that_are_wanted_is_not_enough(done):
    scenario, result, folder = done
    nodes = [
        NodeResult(
            *(0, "uavs[0]", "Tested", (0.0, 0.0, 0.0), {}),
            frame_outcomes={},
            interferers={},
            message_outcomes={},
        ),
        NodeResult(1, "uavs[1]", "Tested", (0.0, 0.0, 0.0), {}),
    ]
    write_run_file(dataclasses.replace(result, nodes=tuple(nodes)), folder)
    assert is_done(scenario, "integrated", folder, outcomes_at=[0])
    assert not is_done(scenario, "integrated", folder, outcomes_at=[0, 1])


@pytest.mark.parametrize("content", [b"", b"[]", b"{}", b'{"run": ', b"\xff", b"[" * 99_999])
def test_a_file_of_something_else_is_no_result(done, content):
    scenario, result, folder = done
    write_run_file(result, folder).write_bytes(content)
    assert not is_done(scenario, "integrated", folder)


@pytest.fixture
def written(done):
    """Return a scenario, the directory with its result, and a capture named in the result."""
    scenario, result, folder = done
    folder.mkdir()
    capture = folder / "a.pcap"
    capture.write_bytes(b"frames")
    write_run_file(result, folder, [capture])
    return scenario, folder, capture


def test_files_that_a_result_names_are_those_of_its_run(written):
    scenario, folder, capture = written
    assert has_written(scenario, "integrated", folder, [capture])
    assert has_written(scenario, "integrated", folder, [])
    assert not has_written(scenario, "integrated", folder, [capture, folder / "b.pcap"])
    assert not has_written(scenario, "prototype", folder, [capture])


@pytest.mark.parametrize("content", [b"", b"frame", b"frames of another run"])
def test_files_that_are_others_now_are_not_those_of_the_run(written, content):
    scenario, folder, capture = written
    capture.write_bytes(content)
    assert not has_written(scenario, "integrated", folder, [capture])


def test_files_that_are_gone_are_not_those_of_the_run(written):
    scenario, folder, capture = written
    capture.unlink()
    assert not has_written(scenario, "integrated", folder, [capture])


@pytest.mark.parametrize("hashes", [b"[]", b'{"a.pcap": ""}', b'"a.pcap"'])
def test_a_result_with_something_else_in_the_place_of_hashes_names_no_files(written, hashes):
    scenario, folder, capture = written
    capture.unlink()
    (folder / "General-#0.integrated.json").write_bytes(b'{"output_hashes": ' + hashes + b"}")
    assert not has_written(scenario, "integrated", folder, [capture])


def test_a_folder_in_the_place_of_the_file_is_named_once(tmp_path):
    taken = write_run_file(RESULT, tmp_path)
    taken.unlink()
    taken.mkdir()
    with pytest.raises(IsADirectoryError) as raised:
        write_run_file(RESULT, tmp_path)
    assert str(raised.value).count(str(taken)) == 1


def test_a_file_of_an_earlier_version_has_the_names_of_now():
    (file,) = EARLIER.iterdir()
    result = read_run_file(file)
    assert list(result)[10] == "outcomes"
    assert result["outcomes"]["frames"]["broadcast"]["receiver_locked"] == 6
    *others, station = result["nodes"]
    assert station["frame_outcomes"] == {"broadcast": {"receiver_transmitting": 6}}
    assert station["message_outcomes"] == {"wlan[0]": {"broadcast": {"sent": 29, "queued": 1}}}
    assert not any("outcomes" in name for node in others for name in node)
    assert "fates" not in json.dumps(result)


def test_the_hash_in_a_file_of_an_earlier_version_is_still_that_of_its_content():
    (file,) = EARLIER.iterdir()
    result = read_run_file(file)
    assert result_hash(result) == result["result_hash"]
