import json
import shutil
from pathlib import Path
from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from gradysim.execution.packing import default_pack, pack
from gradysim.results.verify import verify
from python.cli.command import call_gradysim, compiled
from python.damage import damaged
from python.torture.study import ARGUMENTS, OUT, prepare

pytestmark = compiled

per_example = settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])

STEM = "General-#1.integrated"
RESULT = f"{STEM}.json"
OTHERS = ("General-#1-nodes[0].pcap", f"{STEM}.html", f"{STEM}.sca", f"{STEM}.vec")


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a directory with the files of two runs."""
    folder = tmp_path_factory.mktemp("study")
    prepare(folder)
    done = call_gradysim(folder, *ARGUMENTS, "-r", "0,1", "--set", "sim-time-limit=1s")
    assert done.returncode == 0, done.stderr
    return folder / OUT


@pytest.fixture
def copy(study: Path, tmp_path: Path) -> Path:
    shutil.copytree(study, tmp_path / "out")
    return tmp_path / "out"


def bad(directory: Path) -> dict[str, str]:
    return {file.path.name: file.problem for file in verify(directory) if file.problem}


def test_each_file_is_verified_by_its_hash(study: Path) -> None:
    files = list(verify(study))
    assert sorted(file.path for file in files) == sorted(study.iterdir())
    assert {(file.problem, file.has_hash) for file in files} == {("", True)}


@pytest.mark.parametrize("name", [RESULT, *OTHERS])
@given(random=st.randoms(use_true_random=False))
@settings(per_example, max_examples=10)
def test_damage_is_found_by_the_hash(study: Path, tmp_path: Path, name: str, random: Random) -> None:
    shutil.copytree(study, tmp_path, dirs_exist_ok=True)
    (tmp_path / name).write_bytes(damaged((tmp_path / name).read_bytes(), random))
    assert list(bad(tmp_path)) == [name]


@pytest.mark.parametrize("name", OTHERS)
def test_a_missing_file_is_found(copy: Path, name: str) -> None:
    (copy / name).unlink()
    assert bad(copy) == {name: f"it is missing; {copy / RESULT} names it"}


@pytest.mark.parametrize("name", OTHERS)
def test_the_file_of_another_run_is_found(copy: Path, name: str) -> None:
    shutil.copy(copy / name.replace("#1", "#0"), copy / name)
    assert bad(copy) == {name: f"it does not fit its hash in {copy / RESULT}"}


def test_files_of_packed_runs_are_found(copy: Path) -> None:
    pack(copy, default_pack(copy), remove=True)
    assert bad(copy) == {}
    for name in OTHERS:
        (copy / name).write_bytes(b"")
    assert sorted(bad(copy)) == sorted(OTHERS)


def test_a_damaged_pack_is_found(copy: Path) -> None:
    pack(copy, default_pack(copy), remove=True)
    default_pack(copy).write_bytes(damaged(default_pack(copy).read_bytes(), Random(0)))
    assert [*bad(copy)] == [default_pack(copy).name]
    assert [*bad(default_pack(copy))] == [default_pack(copy).name]


def test_a_result_in_place_of_a_packed_one_counts(copy: Path) -> None:
    pack(copy, default_pack(copy))
    result = json.loads((copy / RESULT).read_text())
    del result["output_hashes"], result["checksum"]
    (copy / RESULT).write_text(json.dumps(result))
    (copy / OTHERS[0]).unlink()
    assert bad(copy) == {RESULT: "it has no checksum"}


@pytest.mark.parametrize("name", OTHERS)
def test_an_incomplete_file_is_found_without_a_result(copy: Path, name: str) -> None:
    (copy / RESULT).unlink()
    assert bad(copy) == {}
    (copy / name).write_bytes((copy / name).read_bytes()[:-20])
    assert [*bad(copy)] == [name]


@pytest.mark.parametrize("name", OTHERS)
@given(random=st.randoms(use_true_random=False))
@settings(per_example, max_examples=10)
def test_any_damage_without_a_result_is_a_problem_in_one_line(
    study: Path, tmp_path: Path, name: str, random: Random
) -> None:
    (tmp_path / name).write_bytes(damaged((study / name).read_bytes(), random))
    (found,) = verify(tmp_path)
    assert not found.has_hash
    assert "\n" not in found.problem
    assert str(tmp_path) not in found.problem


def test_other_files_are_left_out(copy: Path) -> None:
    for name in ("figure.json", "notes.html", "General-#0.sca", f"{RESULT}.4711"):
        (copy / name).write_text("{}")
    assert bad(copy) == {}
