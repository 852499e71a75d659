"""Verifies the files in a directory of results: each is complete, and as its run left it.

A result file has a checksum, and the hashes of the other files of its run. A pack has a checksum, too. Of a
file that no result names, only the structure is known, so that some damage stays unnoticed.
"""

import re
import struct
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from gradysim.replay.reader import read_replay
from gradysim.results.files import CHECKSUM, is_run_file
from gradysim.results.omnetpp_reader import check_structure as check_database
from gradysim.results.pack import packed_texts, packs_of
from gradysim.results.result_dir import loose_files, result_of
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.resolve.runs import hash_of

_CAPTURE = re.compile(r".+-#\d+-.+\.pcap")
_CAPTURE_HEADER = struct.Struct("<I20x")
_FRAME_HEADER = struct.Struct("<8xII")
_NANOSECOND_MAGIC = 0xA1B23C4D


class Verified(NamedTuple):
    """A file of results.

    Attributes:
        path: Its path.
        problem: What is wrong with it; "" if nothing is.
        has_hash: Whether a checksum or a hash covers all of its content.
    """

    path: Path
    problem: str = ""
    has_hash: bool = True


class _Result(NamedTuple):
    """A result in a file or in a pack.

    Attributes:
        path: The file or the pack.
        time_ns: Time of its last change.
        hashes: Hashes of the other files of its run, by name.
    """

    path: Path
    time_ns: int
    hashes: Mapping[str, str]


def verify(directory: Path) -> Iterator[Verified]:
    """Yield each file of results in a directory, or the pack that `directory` is.

    Other files and unfinished ones are left out. Raises OSError if the directory cannot be read.
    """
    results: dict[str, _Result] = {}
    for pack in packs_of(directory):
        yield _verified_pack(pack, directory, results)
    if directory.is_file():
        return
    for name, state in sorted(loose_files(directory).items()):
        yield from _verified_result(directory / name, state.time_ns, results)
    named = {name: result for result in results.values() for name in result.hashes}
    for name in sorted(named):
        yield _verified_by_hash(directory / name, named[name])
    for file in sorted(directory.iterdir()):
        if file.name not in named and (check := _check_of(file)):
            yield _verified_by_structure(file, check)


def _verified_pack(pack: Path, directory: Path, results: dict[str, _Result]) -> Verified:
    """Verify a pack, and add its results that are newer."""
    try:
        for name, state, content in packed_texts(pack):
            result = result_of(content, directory / name) or {}
            if name not in results or results[name].time_ns < state.time_ns:
                results[name] = _Result(pack, state.time_ns, _hashes(result))
    except (ConfigError, OSError) as error:
        return Verified(pack, _problem(pack, error))
    return Verified(pack)


def _verified_result(file: Path, time_ns: int, results: dict[str, _Result]) -> Iterator[Verified]:
    """Verify a JSON file if it is a result, and add it, in place of a packed one."""
    try:
        result = result_of(file.read_bytes(), file)
    except (ConfigError, OSError) as error:
        yield Verified(file, _problem(file, error))
        return
    if result is not None:
        results[file.name] = _Result(file, time_ns, _hashes(result))
    if result is not None or is_run_file(file.name):
        yield Verified(file, "" if result and CHECKSUM in result else "it has no checksum")


def _hashes(result: Mapping[str, object]) -> Mapping[str, str]:
    hashes = result.get("output_hashes")
    return hashes if isinstance(hashes, dict) else {}


def _verified_by_hash(file: Path, result: _Result) -> Verified:
    if not file.is_file():
        return Verified(file, f"it is missing; {result.path} names it")
    if hash_of(file) != result.hashes[file.name]:
        return Verified(file, f"it does not fit its hash in {result.path}")
    return Verified(file)


def _verified_by_structure(file: Path, check: Callable[[Path], None]) -> Verified:
    try:
        check(file)
    except (OSError, ValueError) as error:
        return Verified(file, _problem(file, error), has_hash=False)
    return Verified(file, has_hash=False)


def _problem(file: Path, error: OSError | ValueError) -> str:
    """Return what an error says, in one line and without the name of the file."""
    if isinstance(error, ConfigError):
        return error.message
    text = (error.strerror if isinstance(error, OSError) else None) or str(error)
    return " ".join(text.removeprefix(f"{file}: ").split())


def _check_of(file: Path) -> Callable[[Path], None] | None:
    """Return what raises an error about an incomplete file of a run; None for a file of another kind."""
    is_ours = _CAPTURE.fullmatch(file.name) or is_run_file(f"{file.stem}.json")
    return _CHECKS.get(file.suffix) if is_ours and file.is_file() else None


def _check_replay(file: Path) -> None:
    if read_replay(file).end is None:
        raise ValueError("it ends before its run did")


def _check_capture(file: Path) -> None:
    """Check the header of a capture, and that its last frame is complete.

    Source: IETF draft-ietf-opsawg-pcap.
    """
    with file.open("rb") as content:
        try:
            (magic,) = _CAPTURE_HEADER.unpack(content.read(_CAPTURE_HEADER.size))
            if magic != _NANOSECOND_MAGIC:
                raise ValueError("it is not a capture of gradysim")
            while header := content.read(_FRAME_HEADER.size):
                captured_bytes, frame_bytes = _FRAME_HEADER.unpack(header)
                if captured_bytes != frame_bytes or len(content.read(frame_bytes)) != frame_bytes:
                    raise ValueError("its frames are damaged, or the last one is incomplete")
        except struct.error as error:
            raise ValueError("its last frame is incomplete") from error


_CHECKS: Mapping[str, Callable[[Path], None]] = {
    ".sca": check_database,
    ".vec": check_database,
    ".html": _check_replay,
    ".pcap": _check_capture,
}
