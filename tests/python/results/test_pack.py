import errno
import json
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from gradysim.execution.packing import pack
from gradysim.results.file_checksum import append_checksum, remove_checksum
from gradysim.results.omnetpp_reader import read_scalars
from gradysim.results.pack import (
    Compressor,
    PackedFile,
    conditions_of,
    packed_bytes,
    packed_files,
    packed_summaries,
    packed_texts,
    packs_of,
    unpacked,
)
from gradysim.results.run_summary import RunSummary


def result(run: int = 0, **changes: Any) -> dict[str, Any]:
    return {
        "config": "Study",
        "mode": "integrated",
        "run": run,
        "seed": 2**62 + run,
        "interrupted": False,
        "events": 7,
        "cpu_s": 0.25,
        "settings_hash": "a1",
        "file_hashes": {"hello.py": "b2"},
        "iterations": {"jitter": "10ms"},
        "outcomes": {"messages": {"unicast": {"acknowledged": 3, "retry_limit": 1}}},
        "nodes": [
            {"name": "uavs[0]", "tracked_variables": {"heard": 1 + run, "late": "inf"}},
            {"name": "uavs[1]", "tracked_variables": {"heard": 3, "text": "a"}},
        ],
        "message_delays": {"unicast": {"mean_s": 0.1 + run}},
        **changes,
    }


def packed(directory: Path, *results: dict[str, Any]) -> Path:
    for each in results:
        (directory / f"{each['config']}-#{each['run']}.json").write_text(json.dumps(each))
    file = directory / "packs" / "runs.sca"
    pack(directory, file)
    return file


def test_a_summary_is_the_same_as_that_of_the_json_file(tmp_path: Path) -> None:
    several = [result(0), result(1, nodes=[]), result(2, seed=None, iterations={"jitter": 5})]
    file = packed(tmp_path, *several)
    found = [summary for _, summary, _ in packed_summaries(file, tmp_path)]
    assert found == [RunSummary.of(each, tmp_path / f"Study-#{each['run']}.json") for each in several]
    assert [type(number) for number in found[0].numbers.values()] == [
        type(number) for number in RunSummary.of(several[0]).numbers.values()
    ]


def test_repetitions_share_their_conditions(tmp_path: Path) -> None:
    file = packed(tmp_path, result(0), result(1))
    first, second = (summary for _, summary, _ in packed_summaries(file, tmp_path))
    assert first.conditions is second.conditions


def test_whether_a_run_was_interrupted_is_known(tmp_path: Path) -> None:
    file = packed(tmp_path, result(0), result(1, interrupted=True))
    assert [interrupted for _, _, interrupted in packed_summaries(file, tmp_path)] == [False, True]


def test_a_file_is_found_by_its_name(tmp_path: Path) -> None:
    packed(tmp_path, result(0), result(1))
    for run in range(2):
        file = tmp_path / f"Study-#{run}.json"
        assert packed_bytes(file) == file.read_bytes()
    assert packed_bytes(tmp_path / "Study-#2.json") is None


def test_the_state_of_a_file_is_known(tmp_path: Path) -> None:
    file = packed(tmp_path, result())
    status = (tmp_path / "Study-#0.json").stat()
    assert packed_files(file) == {"Study-#0.json": PackedFile(status.st_size, status.st_mtime_ns)}


def test_tools_for_omnetpp_read_the_numbers(tmp_path: Path) -> None:
    rows = read_scalars(packed(tmp_path, result(0), result(1)), "uavs[*] heard")
    assert [(row["runID"], row["value"], row["jitter"], row["runnumber"]) for row in rows] == [
        ("Study-#0", 2.0, "10ms", "0"),
        ("Study-#1", 2.5, "10ms", "1"),
    ]


def test_packs_are_in_a_directory_of_their_own(tmp_path: Path) -> None:
    assert packs_of(tmp_path) == packs_of(tmp_path / "missing") == []
    file = packed(tmp_path, result())
    (file.parent / "notes.txt").touch()
    assert packs_of(tmp_path) == packs_of(file) == [file]


def test_another_file_is_an_error_that_names_it(tmp_path: Path) -> None:
    file = tmp_path / "packs" / "other.sca"
    file.parent.mkdir()
    file.write_text("version 3")
    with pytest.raises(OSError, match="pack") as raised:
        packed_files(file)
    assert raised.value.filename == str(file)


def change(pack: Path, statement: str) -> None:
    remove_checksum(pack)
    with closing(sqlite3.connect(pack, isolation_level=None)) as connection:
        connection.execute(statement)


def read_all(pack: Path, directory: Path) -> None:
    packed_files(pack)
    list(packed_summaries(pack, directory))
    list(packed_texts(pack))


def test_a_pack_without_a_checksum_is_an_error(tmp_path: Path) -> None:
    file = packed(tmp_path, result())
    change(file, "UPDATE packedRun SET seed = 8")
    with pytest.raises(OSError, match="again") as raised:
        packed_files(file)
    assert (raised.value.errno, raised.value.filename) == (errno.EIO, str(file))
    with pytest.raises(ValueError, match="checksum"):
        read_scalars(file)


@pytest.mark.parametrize(
    "statement",
    [
        "DROP TABLE packedRun",
        "UPDATE packedRun SET fileName = 5",
        "UPDATE packedRun SET fileName = CAST('../a.json' AS BLOB)",
        "UPDATE packedRun SET conditionsId = 99",
        "UPDATE packedRun SET numbers = x'00'",
        "UPDATE packedRun SET numbers = 'text'",
        "UPDATE packedRun SET leftOut = '{'",
        "UPDATE packedConditions SET conditions = '[]'",
        "UPDATE packedConditions SET conditions = CAST(x'ff' AS TEXT)",
        "UPDATE packedConditions SET layout = 'text'",
        "UPDATE packedDictionary SET text = x'00'",
        "UPDATE packedText SET text = 5",
    ],
)
def test_an_unexpected_value_is_an_error_that_names_the_pack(tmp_path: Path, statement: str) -> None:
    file = packed(tmp_path, result())
    change(file, statement)
    append_checksum(file)
    with pytest.raises(OSError, match="damaged") as raised:
        read_all(file, tmp_path)
    assert (raised.value.errno, raised.value.filename) == (errno.EIO, str(file))


def test_texts_like_the_sample_are_small() -> None:
    sample, text = (json.dumps(result(run), indent=2).encode() for run in (0, 1))
    compressed = Compressor(sample).packed(text)
    assert unpacked(compressed, sample) == text
    assert len(compressed) < len(text) / 10


def test_a_number_that_is_too_large_for_64_bits_is_a_float() -> None:
    layouts = [conditions_of(RunSummary.of(result(events=events)))[0] for events in (7, 2**70)]
    assert [layout.count("q") for layout in layouts] == [1, 0]
