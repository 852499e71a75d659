"""Damaged packs: each command refuses them in one line, prints no numbers, and loses nothing."""

import errno
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from random import Random

import pytest

from gradysim.cli.errors import MISTAKE
from gradysim.execution.packing import pack, unpack
from gradysim.results.files import bytes_of
from gradysim.results.omnetpp_reader import read_scalars
from gradysim.results.result_dir import read_results, result_names
from python.cli.command import call_gradysim
from python.damage import damaged
from python.study_files import write_result
from python.torture.study import prepare

_OUT = Path("out")
_PACK = _OUT / "packs" / "runs.sca"
_RUNS = 40
_AT_ONCE = 200
_AT_ONCE_WITH_COMMANDS = 12

FUNCTIONS: tuple[Callable[[Path], object], ...] = (
    lambda folder: read_results(folder / _OUT),
    lambda folder: read_results(folder / _PACK),
    lambda folder: result_names(folder / _OUT),
    lambda folder: bytes_of(folder / _OUT / f"Study-#{_RUNS - 1}.integrated.json"),
    lambda folder: pack(folder / _OUT, folder / _PACK, remove=True),
    lambda folder: pack(folder / _OUT, folder / "other.sca", remove=True),
    lambda folder: unpack(folder / _OUT, [folder / _PACK], remove=True),
)
"""What commands read packs with. The last ones might write or remove files."""

_RUN = ("study.ini", "--result-dir", str(_OUT))
COMMANDS = (
    ("means", str(_OUT), "--csv"),
    ("means", str(_PACK)),
    ("compare", str(_OUT), str(_PACK)),
    ("plot", str(_OUT), "--x", "run", "--y", "uavs[*] heard", "-o", "figure.svg"),
    ("status", str(_OUT), "study.ini"),
    ("run", *_RUN),
    ("run", *_RUN, "--resume"),
    ("pack", str(_OUT), "--remove"),
    ("pack", str(_OUT), "-o", "other.sca", "--remove"),
    ("pack", str(_OUT), "--unpack", "--remove"),
    ("pack", "other", "-o", str(_PACK), "--unpack", "--remove"),
)


def once(random: Random, folder: Path) -> int:
    """Damage a pack many times, and let functions read it, some commands, too. Return how often."""
    prepare(folder)
    (folder / "other").mkdir()
    write_result(folder / _OUT, _RUNS)
    (folder / _PACK).parent.mkdir()
    for number in range(_AT_ONCE):
        (folder / _PACK).unlink(missing_ok=True)
        (folder / _PACK).write_bytes(damaged(packed(), random))
        before = contents(folder)
        for function in FUNCTIONS:
            with pytest.raises(OSError, match="damaged") as raised:
                function(folder)
            assert (raised.value.errno, raised.value.filename) == (errno.EIO, str(folder / _PACK))
        with pytest.raises((OSError, ValueError)):
            read_scalars(folder / _PACK)
        if number < _AT_ONCE_WITH_COMMANDS:
            refuse(folder, random.choice(COMMANDS))
        assert contents(folder) == before
    return _AT_ONCE


def refuse(folder: Path, command: tuple[str, ...]) -> None:
    """Check that a command names the pack in one line, and prints nothing else."""
    done = call_gradysim(folder, *command)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (MISTAKE, "", 1), (command, done)
    assert done.stderr.startswith(f"{_PACK}: "), (command, done)


@cache
def packed() -> bytes:
    """Return the pack of a study."""
    with tempfile.TemporaryDirectory() as name:
        directory = Path(name)
        for run in range(_RUNS):
            write_result(directory, run, heard=[run % 7, 3], iterations={"jitter": f"{run % 2}ms"})
        pack(directory, directory / _PACK.name)
        return (directory / _PACK.name).read_bytes()


def contents(folder: Path) -> dict[str, bytes]:
    """Return the files in a directory by their relative names."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}
