"""The examples that come with the package, and copies of them for users.

A wheel has `configs` and `examples` in the package. An editable installation uses those of the repository.
"""

import re
import shutil
from pathlib import Path

import gradysim

_FILES = {
    "fading": ("configs/fading.ini", "examples/reference/beacon.py", "examples/reference/sink.py"),
    "scouts": ("configs/scouts.ini", "examples/scouts"),
    "sensor_field": ("configs/sensor_field.ini", "examples/sensor_field", "examples/reference/beacon.py"),
    "town": (
        "configs/town/town.ini",
        "configs/town/town.geojson",
        "examples/reference/beacon.py",
        "examples/reference/sink.py",
    ),
    "zigzag": ("configs/zigzag.ini", "examples/zigzag", "examples/paper"),
}
"""{example: its .ini file, then other files and directories}."""

NAMES = tuple(_FILES)

_COMMAND = re.compile(r"^#     ((?:gradysim|python) .*)$", re.MULTILINE)


def _root() -> Path:
    package = Path(gradysim.__file__).parent
    return package if (package / "configs").is_dir() else package.parents[1]


def _text(name: str) -> str:
    return (_root() / _FILES[name][0]).read_text(encoding="utf-8")


def subject(name: str) -> str:
    """Return what an example shows: the first line of its .ini file."""
    return _text(name).partition("\n")[0].removeprefix("# ")


def commands(name: str) -> list[str]:
    """Return the commands in the head of the .ini file, with their comments."""
    return _COMMAND.findall(_text(name))


def copy_files(name: str, directory: Path) -> None:
    """Copy the files of an example into an existing directory. Raises OSError."""
    for path in _FILES[name]:
        source, target = _root() / path, directory / path
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copyfile(source, target)
