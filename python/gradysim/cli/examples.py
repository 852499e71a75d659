"""The examples that come with the package, and copies of them for users.

A wheel has `configs` and `examples` in the package. An editable installation uses those of the repository.
"""

import re
from collections.abc import Iterator
from pathlib import Path

import gradysim

_FILES = {
    "search": ("configs/search.ini", "examples/search"),
    "coverage": ("configs/coverage.ini", "examples/coverage"),
    "relay_chain": ("configs/relay_chain.ini", "examples/relay_chain"),
    "data_mule": ("configs/data_mule.ini", "examples/data_mule"),
    "leader_election": ("configs/leader_election.ini", "examples/leader_election"),
    "collision_avoidance": ("configs/collision_avoidance.ini", "examples/collision_avoidance"),
    "sensor_field": ("configs/sensor_field.ini", "examples/sensor_field", "examples/reference/beacon.py"),
    "town": (
        "configs/town/town.ini",
        "configs/town/town.geojson",
        "examples/reference/beacon.py",
        "examples/reference/sink.py",
    ),
    "hidden_terminals": ("configs/hidden_terminals.ini", "examples/hidden_terminals"),
    "zigzag": ("configs/zigzag.ini", "examples/zigzag", "examples/paper"),
    "scouts": ("configs/scouts.ini", "examples/scouts"),
    "fading": ("configs/fading.ini", "examples/reference/beacon.py", "examples/reference/sink.py"),
}
"""{example: its .ini file, then other files and directories}, in the order of docs/gallery.md."""

NAMES = tuple(_FILES)

_FOLDER = re.compile(r"(?<![\w/.])(?:\.\./)*(?:configs/(?:town/)?|examples/\w+/)(?=\w)")
"""Folders of the repository: a copy has all files in one."""

_SCENARIOS = re.compile(r'parents\[2\] / "configs"')
"""The folder of the scenarios, seen from that of a script."""

_COMMAND = re.compile(r"^#     ((?:gradysim|python) .*)$", re.MULTILINE)


def files_root() -> Path:
    """Return the directory of `configs`, `examples` and `docs`."""
    package = Path(gradysim.__file__).parent
    return package if (package / "configs").is_dir() else package.parents[1]


def _text(name: str) -> str:
    return (files_root() / _FILES[name][0]).read_text(encoding="utf-8")


def subject(name: str) -> str:
    """Return what an example shows: the first line of its .ini file."""
    return _text(name).partition("\n")[0].removeprefix("# ")


def commands(name: str) -> list[str]:
    """Return the commands in the head of the .ini file, with their comments, as they are run in a copy."""
    return [_in_copy(command) for command in _COMMAND.findall(_text(name))]


def files_of(name: str) -> Iterator[str]:
    """Yield the paths of an example's files in the repository, and in a wheel below the package."""
    for path in _FILES[name]:
        source = files_root() / path
        for file in source.rglob("*.py") if source.is_dir() else [source]:
            yield file.relative_to(files_root()).as_posix()


def copy_files(name: str, directory: Path) -> None:
    """Copy the files of an example into an existing directory: its .ini file at the top. Raises OSError."""
    for path in files_of(name):
        target = directory / _in_copy(path)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(_in_copy((files_root() / path).read_text(encoding="utf-8")), encoding="utf-8")


def _in_copy(text: str) -> str:
    """Return a text of the repository as a copy has it, with other paths of files."""
    return _SCENARIOS.sub("parent", _FOLDER.sub("", text))
