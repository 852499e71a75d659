"""Files without an end or a writer: each is rejected at once, with its line."""

import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import BadValue, ConfigError
from gradysim.scenario.parse.regular_files import check_regular
from python.scenario.conftest import BASE

MOST_S = 1.0


@pytest.fixture(autouse=True)
def _no_hang() -> Iterator[None]:
    started_s = time.monotonic()
    yield
    assert time.monotonic() - started_s < 20 * MOST_S  # a pipe without a writer never ends


def make_pipe(path: Path) -> str:
    os.mkfifo(path)
    return path.name


def make_folder(path: Path) -> str:
    path.mkdir()
    return path.name


NOT_REGULAR: list[Callable[[Path], str]] = [
    make_pipe,
    make_folder,
    lambda _: "/dev/zero",
    lambda _: "/dev/tty",
]


@pytest.mark.parametrize("make", NOT_REGULAR)
@pytest.mark.parametrize(
    "line",
    [
        "include {}",
        '*.environment.obstacles = "{}"',
        '**.errorModel.berTableFile = "{}"',
        '*.boat.protocol.class = "{}:Sensor"',
    ],
)
def test_what_is_not_a_regular_file_is_refused_where_it_is_named(
    folder: Any, make: Callable[[Path], str], line: str
) -> None:
    error = folder.mistake(line.format(make(folder.path / "named.py")) + "\n")
    assert (error.file, error.line, error.expected) == (folder.ini, 6, "a regular file")


@pytest.mark.parametrize("make", NOT_REGULAR)
def test_neither_can_the_scenario_itself_be_such_a_file(tmp_path: Path, make: Callable[[Path], str]) -> None:
    file = tmp_path / make(tmp_path / "test.ini")
    with pytest.raises(ConfigError) as caught:
        load_scenarios(file)
    assert (caught.value.file, caught.value.expected) == (file, "a regular file")


def test_regular_and_missing_files_are_left_to_their_reader(tmp_path: Path) -> None:
    (tmp_path / "there").touch()
    for name in ("there", "missing", "n" * 5000, "zero\0byte"):
        check_regular(tmp_path / name)
    with pytest.raises(BadValue, match="directory"):
        check_regular(tmp_path)


def test_a_file_with_all_that_it_includes_is_not_too_large(folder: Any) -> None:
    folder.write("half.ini", "#" * (33 * 2**20))
    error = folder.mistake("include half.ini\ninclude half.ini\n")
    assert (error.file, error.line, error.expected) == (folder.ini, 7, "less")


def test_files_that_include_two_others_each_come_to_an_end(folder: Any) -> None:
    for depth in range(40):
        folder.write(f"{depth}.ini", f"include {depth + 1}.ini\n" * 2)
    folder.write("40.ini", "")
    folder.write("test.ini", BASE + "include 0.ini\n")
    with pytest.raises(ConfigError) as caught:
        load_scenarios(folder.ini)
    assert (caught.value.file.parent, caught.value.expected) == (folder.path, "at most 1000 included files")
