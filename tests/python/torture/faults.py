"""Each command with a fault at its n-th system call: it ends complete, or names the file, and loses nothing.

The command, repeated on a good disk, then completes its work.
"""

import shutil
import signal
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

from gradysim.results.files import is_run_file
from gradysim.results.pack import PACKS, packed_texts, packs_of
from python.torture.bad_disk import FAULTS, BadDisk, Done
from python.torture.study import OUT, content_of_file, content_of_result, prepare

_ALL_FILES = ("--scalars", "--vectors", "all", "--replay", "all", "--pcap", "nodes[0]")
_RUN = ("run", "study.ini", "--quiet", "-r", "0", "--result-dir", OUT, *_ALL_FILES)
_OLD, _NEW = ("--set", "sim-time-limit=1s"), ("--set", "sim-time-limit=2s")
_MANY = ("run", "study.ini", "--quiet", "-r", "0,2,4", "--result-dir", OUT, *_NEW)
_PACK = ("pack", OUT, "--remove")
_UNPACK = ("pack", OUT, "--unpack", "--remove")
_PLOT = ("plot", OUT, "--x", "$nodes", "--y", "events", "-o", f"{OUT}/figure.svg")

_NO_CALL = 2**40
"""More calls than a command makes."""


@dataclass(frozen=True)
class Case:
    """A command on the bad disk.

    Attributes:
        before: Commands that make the state before it.
        command: The command.
        again: The command on a good disk that completes its work.
        removed: Pattern of files that are removed before the command.
    """

    before: Sequence[Sequence[str]]
    command: Sequence[str]
    again: Sequence[str]
    removed: str = ""


CASES = {
    "run": Case([], (*_RUN, *_NEW), (*_RUN, *_NEW, "--resume")),
    "run --replace": Case(
        [(*_RUN, *_OLD)], (*_RUN, *_NEW, "--replace"), (*_RUN, *_NEW, "--resume", "--replace")
    ),
    "run --resume": Case([(*_RUN, *_NEW)], (*_RUN, *_NEW, "--resume"), (*_RUN, *_NEW, "--resume"), "*.html"),
    "pack": Case([_MANY], _PACK, _PACK),
    "pack --unpack": Case([_MANY, _PACK], _UNPACK, _UNPACK),
    "plot": Case([_MANY], _PLOT, _PLOT),
}


class Bench:
    """A command on a bad disk, and its undisturbed results."""

    def __init__(self, name: str, folder: Path, disk: BadDisk) -> None:
        """Run the command undisturbed in a new directory."""
        self._case, self._folder, self._disk = CASES[name], folder, disk
        self._before = folder / "before"
        prepare(folder)
        (folder / OUT).mkdir()
        for command in self._case.before:
            assert disk.run(folder, command).code == 0
        if self._case.removed:
            for file in (folder / OUT).glob(self._case.removed):
                file.unlink()
        shutil.copytree(folder / OUT, self._before)
        self._old = _content(folder / OUT)
        done = disk.run(folder, self._case.command)
        assert done.code == 0, done
        self._new = _content(folder / OUT)

    def calls(self, fault: str) -> int:
        """Return how many calls of the command have a fault."""
        self._restore()
        return self._disk.run(self._folder, self._case.command, fault, _NO_CALL).calls

    def check(self, fault: str, at: int) -> Done:
        """Run the command with a fault at a call. Fails if something is lost, or is not told in a line."""
        self._restore()
        done = self._disk.run(self._folder, self._case.command, fault, at)
        try:
            found = _content(self._folder / OUT)
            self._check_told(done, fault)
            for name in found:
                assert self._is_old_or_new(name, found), name
            if done.code == 0:
                assert found == self._new
            else:
                self._check_kept(found)
            again = self._disk.run(self._folder, self._case.again)
            assert again.code == 0, again
            assert _content(self._folder / OUT) == self._new
        except BaseException as failure:
            failure.add_note(f"{' '.join(self._case.command)}: {fault} at call {at}: {done}")
            raise
        return done

    def _is_old_or_new(self, name: str, found: dict[str, Any]) -> bool:
        """Return whether a file is as before or as after the command, or of the result of a run under way.

        A result is written before the other files of its run, and again with their hashes. It is marked as
        interrupted if the run lacks a capture or a replay.
        """
        content, old, new = found[name], self._old.get(name), self._new.get(name)
        if content in (old, new):
            return True
        result = found.get(f"{name.rpartition('.')[0]}.json", {})
        if result.get("interrupted"):
            return old is None and not name.endswith((".pcap", ".html"))
        return isinstance(new, dict) and content == {**new, "output_hashes": {}}

    def _check_told(self, done: Done, fault: str) -> None:
        assert "Traceback" not in done.error_output
        if fault == "KILL":
            assert done.code in (0, 1, -signal.SIGKILL)
        elif done.code:
            assert done.code in (1, 2)
            named = [line for line in done.error_output.splitlines() if f"{OUT}/" in line]
            # A disk that stays full may cut the capture and the replay.
            assert len(named) in ((1, 2) if fault == "ENOSPC" else (1,))
        if not done.failed:
            assert done.code == 0

    def _check_kept(self, found: dict[str, Any]) -> None:
        """Fail if a result is gone that was there, loose or in a pack."""
        before, after = (
            {Path(name).name for name in files if is_run_file(Path(name).name)}
            for files in (self._old, found)
        )
        assert before <= after

    def _restore(self) -> None:
        shutil.rmtree(self._folder / OUT)
        shutil.copytree(self._before, self._folder / OUT)


def _content(directory: Path) -> dict[str, Any]:
    """Return the content of the finished files, and of the results in packs, as `packs/NAME`."""
    loose = {
        file.name: content_of_file(file)
        for file in directory.iterdir()
        if file.is_file() and not (file.suffix[1:].isdecimal() or file.name.startswith(".gradysim."))
    }
    packed = {
        f"{PACKS}/{name}": content_of_result(text)
        for pack in packs_of(directory)
        for name, _, text in packed_texts(pack)
    }
    return {**loose, **packed}


def once(random: Random, folder: Path) -> int:
    """Check a command with a fault at each of its calls; return their number."""
    name, fault = random.choice(list(CASES)), random.choice(FAULTS)
    with BadDisk(OUT) as disk:
        bench = Bench(name, folder, disk)
        count = bench.calls(fault)
        for at in range(1, count + 1):
            bench.check(fault, at)
    return max(count, 1)  # `plot` takes no lock
