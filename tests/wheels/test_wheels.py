"""The wheels and the source distribution in `dist` do what the sources do: `make wheels` ends with this."""

import json
import os
import re
import subprocess
import sys
import tarfile
from pathlib import Path
from zipfile import ZipFile

import pytest
from elftools.elf.elffile import ELFFile
from emulated_python import emulated, unpack_python
from packaging.tags import Tag
from packaging.utils import parse_wheel_filename

from pythons import ARCHITECTURES, BUILD, DIST, PLATFORM, ROOT, pythons

HOST = os.uname().machine
COMPILED = sorted(DIST.glob("*manylinux*.whl"))
MACHINES = {"x86_64": "EM_X86_64", "aarch64": "EM_AARCH64"}

each_compiled = pytest.mark.parametrize("wheel", COMPILED, ids=lambda wheel: str(tag_of(wheel)))


def tag_of(wheel: Path) -> Tag:
    (tag,) = parse_wheel_filename(wheel.name)[3]
    return tag


def architecture_of(wheel: Path) -> str:
    return tag_of(wheel).platform.removeprefix(f"{PLATFORM}_")


def version_of(wheel: Path) -> str:
    return tag_of(wheel).interpreter.replace("cp3", "3.")


def run(*command: str | Path, **variables: str | Path) -> str:
    """What a command prints. It sees neither the sources of this project nor its packages."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    variables_of_text = {name: str(value) for name, value in variables.items()}
    ended = subprocess.run(command, env=environment | variables_of_text, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return ended.stdout


def fresh_environment(python: str, wheel: Path, directory: Path) -> Path:
    """The commands of a new virtual environment with the wheel and what it needs."""
    run(python, "-m", "venv", directory)
    run(directory / "bin/pip", "install", "--quiet", wheel)
    return directory / "bin"


@pytest.fixture(scope="session")
def foreign_python() -> Path:
    """A Python of the architecture that is not this machine's."""
    (foreign,) = set(ARCHITECTURES) - {HOST}
    return unpack_python(foreign, BUILD / f"python-{foreign}")


@pytest.fixture(scope="session")
def without_engine() -> Path:
    """The wheel for systems that have no other."""
    (wheel,) = DIST.glob("*-py3-none-any.whl")
    return wheel


@pytest.fixture(scope="session")
def gradysim(without_engine: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The command of an environment with that wheel."""
    return fresh_environment(sys.executable, without_engine, tmp_path_factory.mktemp("pure")) / "gradysim"


def test_there_is_a_wheel_for_each_python_and_architecture() -> None:
    expected = {(version, architecture) for version in pythons() for architecture in ARCHITECTURES}
    assert {(version_of(wheel), architecture_of(wheel)) for wheel in COMPILED} == expected


@each_compiled
def test_the_engine_is_compiled_for_the_tag_of_its_wheel(wheel: Path) -> None:
    version, architecture = tag_of(wheel).interpreter.replace("cp", "cpython-"), architecture_of(wheel)
    with (
        ZipFile(wheel) as files,
        files.open(f"gradysim/_netsim.{version}-{architecture}-linux-gnu.so") as file,
    ):
        assert ELFFile(file)["e_machine"] == MACHINES[architecture]


@each_compiled
def test_it_needs_no_newer_system_than_its_tag_says(wheel: Path) -> None:
    shown = json.loads(run(sys.executable, "-m", "auditwheel", "show", "--json", wheel))
    needed = re.match(r"manylinux_(\d+)_(\d+)_", shown["overall_tag"])
    promised = re.match(r"manylinux_(\d+)_(\d+)", PLATFORM)
    assert needed is not None
    assert promised is not None
    assert [int(part) for part in needed.groups()] <= [int(part) for part in promised.groups()]


@each_compiled
def test_all_examples_give_what_they_give_with_the_sources(
    wheel: Path, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    compare = Path(__file__).with_name("compare_hashes.py")
    version, architecture = version_of(wheel), architecture_of(wheel)
    if architecture == HOST:
        print(run(fresh_environment(pythons()[version], wheel, tmp_path) / "python", compare))
        return
    platform = [f"--platform={tag_of(wheel).platform}", f"--python-version={version}", "--only-binary=:all:"]
    run(sys.executable, "-m", "pip", "install", "--quiet", *platform, "--target", tmp_path, wheel)
    python = request.getfixturevalue("foreign_python")
    if python.name != f"python{version}":
        pytest.skip(
            f"installed, but not run: Debian has no Python {version} for {architecture}, only {python.name}"
        )
    print(run(*emulated(architecture, python), compare, PYTHONPATH=tmp_path))


def test_prototype_mode_runs_without_the_engine(gradysim: Path) -> None:
    run(gradysim, "run", ROOT / "configs/zigzag.ini", "-c", "ZigZag5", "--mode", "prototype")


def test_integrated_mode_says_in_a_sentence_that_the_engine_is_missing(gradysim: Path) -> None:
    command = [gradysim, "run", ROOT / "configs/zigzag.ini", "-c", "ZigZag5", "--mode", "integrated"]
    (sentence,) = subprocess.run(command, capture_output=True, text=True).stderr.splitlines()
    assert "integrated mode needs the compiled part of gradysim" in sentence


def test_the_source_distribution_has_all_sources() -> None:
    tracked = run("git", "-C", ROOT, "ls-files", "cpp", "python").splitlines()
    (sources,) = DIST.glob("*.tar.gz")
    with tarfile.open(sources) as archive:
        packed = {name.partition("/")[2] for name in archive.getnames()}
    assert set(tracked) <= packed


def test_a_wheel_can_be_built_from_the_source_distribution(without_engine: Path, tmp_path: Path) -> None:
    (sources,) = DIST.glob("*.tar.gz")
    settings = ["-Cwheel.cmake=false", "-Cwheel.py-api=py3"]
    run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "-w", tmp_path, *settings, sources)
    with ZipFile(tmp_path / without_engine.name) as built, ZipFile(without_engine) as expected:
        assert built.namelist() == expected.namelist()
