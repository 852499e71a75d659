"""Files that others may have written, changed at random: each is read or refused, in bounded time.

Changed are the files of `tests/corpus`, of which each reader has a directory, and files that are made here.
A changed file that found a bug is kept there as `damaged-…`. The reader of .ini files has more changes, in
`mutant_files`.
"""

import json
import os
import re
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from random import Random
from typing import Any

import pytest

from gradysim.cli.errors import OK
from gradysim.execution.packing import unpack as unpack_results
from gradysim.omnetpp_import import translate
from gradysim.replay.chunk import unpack
from gradysim.replay.file import read_parts
from gradysim.replay.reader import read_replay
from gradysim.results.file_checksum import LINE_BYTES, append_checksum
from gradysim.results.result_dir import read_results
from gradysim.results.verify import verify
from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError
from python.cli.command import call_gradysim
from python.damage import damaged
from python.torture.damage import packed
from python.torture.mutant_files import ROOT, changed
from python.torture.mutants import LONGEST_MESSAGE, in_bounded_time
from python.torture.study import OUT, prepare

AT_ONCE = 60
_ODD: tuple[Any, ...] = (
    None,
    True,
    -1,
    0.5,
    1e308,
    10**400,
    float("nan"),
    "",
    "x",
    "\0",
    [],
    [[]],
    {},
    [1, 2],
)
_ELEMENT = re.compile(rb'<script [^>]*"gradysim-(?:run|chunk|end)">[^<]*</script>\n?')
_TOWN = """[General]
sim-time-limit = 1s
*.sink.protocol.typename = "SinkProtocol"
*.sink.mobility.typename = "StationaryMobility"
*.coordinateSystem.sceneLatitude = -15deg
*.coordinateSystem.sceneLongitude = -48deg
*.environment.obstacles = "{}"
"""


@dataclass(frozen=True)
class Reader:
    """A reader of files.

    Attributes:
        read: Reads a file, which is alone in its directory.
        change: Changes the content of a file.
        refuses: What `read` raises for a damaged file, with a message for users.
    """

    read: Callable[[Path], object]
    change: Callable[[bytes, Random], bytes]
    refuses: tuple[type[Exception], ...]


def _read_obstacles(file: Path) -> None:
    ini = file.with_name("town.ini")
    ini.write_text(_TOWN.format(file.name))
    load_scenarios(ini)


def _read_pack(file: Path) -> None:
    list(verify(file))
    read_results(file)
    with tempfile.TemporaryDirectory() as directory, pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "sync", lambda: None)  # it takes long, and the machine does not fail
        unpack_results(Path(directory), [file])


def _change_json(content: bytes, random: Random) -> bytes:
    """Replace or remove a random value in a JSON object, or damage its text."""
    try:
        whole = json.loads(content)
    except ValueError:
        return damaged(content, random)
    places = list(_places(whole))
    if not places or random.random() < 0.2:
        return damaged(content, random)
    container, key = random.choice(places)
    if random.random() < 0.3:
        del container[key]
    else:
        container[key] = random.choice((*_ODD, [container[key]]))
    return json.dumps(whole).encode()


def _places(value: Any) -> Iterator[tuple[Any, Any]]:
    """Yield each value in JSON objects and arrays, as (container, key)."""
    for key in value if isinstance(value, dict) else range(len(value) if isinstance(value, list) else 0):
        yield value, key
        yield from _places(value[key])


def _change_chunk(content: bytes, random: Random) -> bytes:
    """Change the header of a chunk and keep its length right, or change any byte."""
    length = int.from_bytes(content[:4], "little")
    header, columns = content[4 : 4 + length], content[4 + length :]
    if random.random() < 0.3 or not header:
        return damaged(content, random)
    header = _change_json(header, random)
    return len(header).to_bytes(4, "little") + header + columns


def _change_pack(content: bytes, random: Random) -> bytes:
    """Damage a pack, and give it the right checksum."""
    with tempfile.TemporaryDirectory() as directory:
        file = Path(directory, "pack")
        file.write_bytes(damaged(content[:-LINE_BYTES] or b"\n", random))
        append_checksum(file)
        return file.read_bytes()


def _change_text(content: bytes, random: Random) -> bytes:
    return changed(content.decode(errors="replace"), random)


READERS = {
    "geojson": Reader(_read_obstacles, _change_json, (ConfigError,)),
    "omnetpp": Reader(lambda file: translate(file, file.parent / "to"), _change_text, (ConfigError, OSError)),
    "chunk": Reader(lambda file: unpack(file.read_bytes()), _change_chunk, (ValueError,)),
    "replay": Reader(read_replay, damaged, (ValueError,)),
    "pack": Reader(_read_pack, _change_pack, (ConfigError, OSError)),
}
"""{directory of `tests/corpus`: its reader}"""


def corpus(name: str) -> list[tuple[str, bytes]]:
    """Return the names and the contents of the files that are changed for a reader."""
    files = sorted((ROOT / "tests" / "corpus" / name).glob("*"))
    made = [_MADE[name]()] if name in _MADE else []
    return [*made, *((file.name, file.read_bytes()) for file in files)]


@cache
def _replay() -> tuple[str, bytes]:
    """Return a replay without the program of its page."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        prepare(folder)
        run = ("run", "study.ini", "-r", "0", "--mode", "prototype", "--set", "sim-time-limit=1s", "--quiet")
        assert call_gradysim(folder, *run, "--replay", "all", "--result-dir", OUT).returncode == OK
        (page,) = (folder / OUT).glob("*.html")
        return "beacons.html", b"".join(_ELEMENT.findall(page.read_bytes()))


@cache
def _chunk() -> tuple[str, bytes]:
    name, content = _replay()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, name)
        file.write_bytes(content)
        _, chunks, _ = read_parts(file)
        return "beacons.chunk", next(chunks)


_MADE = {"pack": lambda: ("runs.sca", packed()), "replay": _replay, "chunk": _chunk}
"""Files whose format changes with the version, as this version writes them."""


def check(name: str, file: Path) -> str:
    """Return why a reader refuses a file, or "". Fails for other errors, long messages and hangs."""
    reader = READERS[name]
    try:
        with in_bounded_time():
            reader.read(file)
    except reader.refuses as error:
        told = str(error)
        assert told
        assert all(len(line) <= LONGEST_MESSAGE for line in told.splitlines())
        return told
    return ""


def once(random: Random, folder: Path, name: str) -> int:
    """Check some changed files of a reader; return how many."""
    sources = corpus(name)
    for _ in range(AT_ONCE):
        file_name, content = random.choice(sources)
        for _ in range(random.choice([1, 1, 2, 4])):
            content = READERS[name].change(content, random) or b"\n"
        file = folder / file_name
        file.write_bytes(content)
        try:
            check(name, file)
        except BaseException as failure:
            kept = Path(tempfile.gettempdir(), f"changed-{file_name}")
            kept.write_bytes(content)
            failure.add_note(f"the file is {kept}; it belongs into tests/corpus/{name}")
            raise
    return AT_ONCE


ONCE: dict[str, Callable[[Random, Path], int]] = {name: partial(once, name=name) for name in READERS}
