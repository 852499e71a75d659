import json
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from gradysim.execution.packing import default_pack, pack, unpack
from gradysim.execution.run_lock import LOCK_FILE, RunLockedError, run_locked
from gradysim.results.durable import unfinished_file
from gradysim.results.files import read_run_file
from gradysim.results.means import read_means
from gradysim.results.pack import packed_files, packed_texts
from gradysim.results.result_dir import read_results, result_names
from gradysim.results.run_table import outcomes_of, runs
from gradysim.scenario.errors import ConfigError


def write(directory: Path, run: int, heard: int = 1, **changes: Any) -> Path:
    result = {
        "config": "Study",
        "mode": "integrated",
        "run": run,
        "seed": run,
        "interrupted": False,
        "iterations": {},
        "outcomes": {},
        "nodes": [{"name": "uavs[0]", "tracked_variables": {"heard": heard}}],
        **changes,
    }
    directory.mkdir(exist_ok=True)
    file = directory / f"Study-#{run}.integrated.json"
    file.write_text(json.dumps(result, indent=2) + "\n")
    return file


def contents(directory: Path) -> dict[str, tuple[bytes, int]]:
    return {file.name: (file.read_bytes(), file.stat().st_mtime_ns) for file in directory.glob("*.json")}


def heard(directory: Path) -> list[float]:
    return [run.numbers["uavs[*] heard"] for run in read_results(directory)]


def test_unpacking_gives_the_same_files(tmp_path: Path) -> None:
    for run in range(20):
        write(tmp_path, run, heard=run)
    before = contents(tmp_path)
    assert pack(tmp_path, default_pack(tmp_path), remove=True) == 20
    assert [file.name for file in tmp_path.iterdir()] == ["packs"]
    assert unpack(tmp_path, [default_pack(tmp_path)], remove=True) == 20
    assert contents(tmp_path) == before
    assert not default_pack(tmp_path).parent.exists()


def test_means_and_results_are_those_of_the_files(tmp_path: Path) -> None:
    for run in range(3):
        write(tmp_path, run, heard=run, iterations={"jitter": run % 2})
    means, results = read_means(tmp_path), read_results(tmp_path)
    pack(tmp_path, default_pack(tmp_path), remove=True)
    assert (read_means(tmp_path), read_results(tmp_path)) == (means, results)
    assert read_run_file(results[1].file)["run"] == 1


def test_a_packed_file_of_an_earlier_version_has_the_names_of_now(tmp_path: Path) -> None:
    (earlier,) = (Path(__file__).parents[1] / "results/earlier_names").iterdir()
    shutil.copy(earlier, tmp_path)
    pack(tmp_path, default_pack(tmp_path), remove=True)
    (run,) = runs(tmp_path)
    assert outcomes_of(run)["messages"]["broadcast"]["queued"] == 2
    assert run.numbers["broadcast frames delivered"] == 30 / 418


def test_a_pack_elsewhere_is_read_by_its_path(tmp_path: Path) -> None:
    file = tmp_path / "study.sca"
    write(tmp_path / "results", 0)
    pack(tmp_path / "results", file)
    (run,) = read_results(file)
    assert read_run_file(run.file)["run"] == 0


def test_new_and_changed_files_are_added(tmp_path: Path) -> None:
    file = default_pack(tmp_path)
    write(tmp_path, 0)
    write(tmp_path, 1)
    assert pack(tmp_path, file) == 2
    assert pack(tmp_path, file) == 0
    write(tmp_path, 1, heard=55)
    write(tmp_path, 2)
    assert pack(tmp_path, file, remove=True) == 2
    assert heard(tmp_path) == [1, 55, 1]
    with closing(sqlite3.connect(file)) as connection:
        for table in ("run", "runAttr", "scalar", "packedRun", "packedText"):
            (count,) = connection.execute(f"SELECT count(DISTINCT runId) FROM {table}").fetchone()
            assert count == 3


def test_a_file_takes_precedence_over_the_pack(tmp_path: Path) -> None:
    write(tmp_path, 0)
    pack(tmp_path, default_pack(tmp_path), remove=True)
    write(tmp_path, 0, heard=55)
    assert heard(tmp_path) == [55]
    assert unpack(tmp_path, [default_pack(tmp_path)]) == 0
    assert heard(tmp_path) == [55]


def test_an_unchanged_file_is_read_from_the_pack(tmp_path: Path) -> None:
    file = write(tmp_path, 0)
    state = file.stat()
    pack(tmp_path, default_pack(tmp_path))
    file.write_bytes(b"x" * state.st_size)
    os.utime(file, ns=(state.st_mtime_ns, state.st_mtime_ns))
    assert heard(tmp_path) == [1]


def test_packs_of_several_machines_are_read_together_and_joined(tmp_path: Path) -> None:
    for run in range(3):
        share = tmp_path / f"share{run}"
        write(share, run, heard=run)
        pack(share, tmp_path / "packs" / f"share{run}.sca")
    assert heard(tmp_path) == [0, 1, 2]
    assert pack(tmp_path, default_pack(tmp_path), remove=True) == 3
    assert list((tmp_path / "packs").iterdir()) == [default_pack(tmp_path)]
    assert heard(tmp_path) == [0, 1, 2]


def test_a_copy_of_a_pack_adds_nothing(tmp_path: Path) -> None:
    write(tmp_path, 0)
    for name in ("a", "b"):
        pack(tmp_path, tmp_path / "packs" / f"{name}.sca")
    (tmp_path / "Study-#0.integrated.json").unlink()
    assert pack(tmp_path, default_pack(tmp_path), remove=True) == 1
    assert heard(tmp_path) == [1]
    assert list((tmp_path / "packs").iterdir()) == [default_pack(tmp_path)]


def test_of_two_packs_the_newer_result_counts(tmp_path: Path) -> None:
    for name, value, time_s in (("a", 55, 200), ("b", 1, 100)):
        os.utime(write(tmp_path / "share", 0, heard=value), (time_s, time_s))
        pack(tmp_path / "share", tmp_path / "packs" / f"{name}.sca")
    assert heard(tmp_path) == [55]
    unpack(tmp_path, [tmp_path / "packs" / "b.sca", tmp_path / "packs" / "a.sca"])
    assert heard(tmp_path) == [55]


def test_a_file_that_differs_from_the_pack_is_not_removed(tmp_path: Path) -> None:
    damaged, other = write(tmp_path, 0), write(tmp_path, 1)
    pack(tmp_path, default_pack(tmp_path))
    state = damaged.stat()
    damaged.write_bytes(damaged.read_bytes().replace(b"1", b"2"))
    os.utime(damaged, ns=(state.st_mtime_ns, state.st_mtime_ns))
    with pytest.raises(OSError, match="removed") as raised:
        pack(tmp_path, default_pack(tmp_path), remove=True)
    assert raised.value.filename == str(damaged)
    assert damaged.exists()
    assert other.exists()


def test_a_pack_with_another_result_of_the_same_time_is_not_removed(tmp_path: Path) -> None:
    packs = [tmp_path / "packs" / f"{name}.sca" for name in ("a", "b")]
    for value, file in enumerate(packs):
        os.utime(write(tmp_path / "share", 0, heard=value), (100, 100))
        pack(tmp_path / "share", file)
    with pytest.raises(OSError, match="removed") as raised:
        pack(tmp_path, default_pack(tmp_path), remove=True)
    assert raised.value.filename == str(packs[1])
    assert sorted(default_pack(tmp_path).parent.iterdir()) == [*packs, default_pack(tmp_path)]


@pytest.mark.parametrize("content", ["{", '{"figure": "a.pdf"}'])
def test_a_pack_stays_if_a_file_in_place_of_its_result_has_none(tmp_path: Path, content: str) -> None:
    file = write(tmp_path, 0)
    pack(tmp_path, default_pack(tmp_path), remove=True)
    file.write_text(content)
    with pytest.raises((ConfigError, OSError)):
        unpack(tmp_path, [default_pack(tmp_path)], remove=True)
    assert default_pack(tmp_path).exists()


def test_a_pack_stays_if_the_disk_loses_what_was_unpacked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = write(tmp_path, 0)
    content = file.read_bytes()
    pack(tmp_path, default_pack(tmp_path), remove=True)
    monkeypatch.setattr(os, "sync", lambda: unfinished_file(file).write_bytes(bytes(len(content))))
    with pytest.raises(OSError, match="stay") as raised:
        unpack(tmp_path, [default_pack(tmp_path)], remove=True)
    assert raised.value.filename == str(file)
    assert [text for _, _, text in packed_texts(default_pack(tmp_path))] == [content]


def test_other_files_stay(tmp_path: Path) -> None:
    (tmp_path / "figure.json").write_text('{"figure": "a.pdf"}')
    assert pack(tmp_path, default_pack(tmp_path), remove=True) == 0
    write(tmp_path, 0)
    assert pack(tmp_path, default_pack(tmp_path), remove=True) == 1
    assert (tmp_path / "figure.json").exists()
    assert result_names(tmp_path) == {"figure.json", "Study-#0.integrated.json"}


def test_a_name_that_is_not_utf_8_is_kept(tmp_path: Path) -> None:
    file = Path(os.fsdecode(bytes(write(tmp_path, 0)).replace(b"Study", b"Stud\xe9")))
    try:
        (tmp_path / "Study-#0.integrated.json").rename(file)
    except OSError:
        pytest.skip("the file system has UTF-8 names only")
    before = contents(tmp_path)
    pack(tmp_path, default_pack(tmp_path), remove=True)
    unpack(tmp_path, [default_pack(tmp_path)])
    assert contents(tmp_path) == before


def test_a_damaged_result_stays_and_is_named(tmp_path: Path) -> None:
    write(tmp_path, 0)
    file = write(tmp_path, 1)
    file.write_text("{")
    with pytest.raises(ConfigError) as raised:
        pack(tmp_path, default_pack(tmp_path), remove=True)
    assert raised.value.file == file
    assert sorted(each.name for each in tmp_path.glob("**/*.*")) == [
        "Study-#0.integrated.json",
        "Study-#1.integrated.json",
    ]


def test_another_file_is_not_replaced(tmp_path: Path) -> None:
    write(tmp_path, 0)
    file = tmp_path / "notes.txt"
    file.write_text("notes")
    with pytest.raises(OSError, match="pack"):
        pack(tmp_path, file)
    assert file.read_text() == "notes"


COMPUTES = """
import sys, time
from pathlib import Path
from gradysim.execution.run_lock import run_locked
with run_locked(Path(sys.argv[1]), "Study-#1"):
    print("begun", flush=True)
    time.sleep(1000)
"""


def process(code: str, directory: Path) -> "subprocess.Popen[str]":
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    arguments = [sys.executable, "-c", code, str(directory)]
    return subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True, env=environment)


def test_a_directory_with_a_run_in_progress_is_not_packed(tmp_path: Path) -> None:
    write(tmp_path, 0)
    with process(COMPUTES, tmp_path) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "begun\n"
        for change in (pack, lambda directory, file: unpack(directory, [file])):
            with pytest.raises(RunLockedError):
                change(tmp_path, default_pack(tmp_path))
        other.kill()
    assert pack(tmp_path, default_pack(tmp_path)) == 1
    assert not (tmp_path / LOCK_FILE).exists()
    with run_locked(tmp_path, "Study-#1"):
        pass


DIES = """
import os, signal, sys
from pathlib import Path
from gradysim.execution import packing
from gradysim.results.durable import finish
packing.{function} = lambda *_: os.kill(os.getpid(), signal.SIGKILL)
packing.pack(Path(sys.argv[1]), packing.default_pack(Path(sys.argv[1])), remove=True)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs SIGKILL")
@pytest.mark.parametrize("function", ["_remove", "_identity_of"])
def test_a_kill_loses_nothing(tmp_path: Path, function: str) -> None:
    write(tmp_path, 0)
    pack(tmp_path, default_pack(tmp_path), remove=True)
    write(tmp_path, 1, heard=2)
    with process(DIES.format(function=function), tmp_path) as killed:
        killed.wait()
    assert heard(tmp_path) == [1, 2]
    left_over = unfinished_file(default_pack(tmp_path), killed.pid).exists()
    assert left_over == (function == "_identity_of")
    pack(tmp_path, default_pack(tmp_path), remove=True)
    assert heard(tmp_path) == [1, 2]
    assert len(packed_files(default_pack(tmp_path))) == 2
    assert list(default_pack(tmp_path).parent.iterdir()) == [default_pack(tmp_path)]
