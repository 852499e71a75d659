"""Each command with a fault at its n-th system call: it ends complete, or names the file, and loses nothing.

What it said is complete stays, also if the power fails. The command, repeated on a good disk, then completes
its work.
"""

import json
import shutil
import signal
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from random import Random
from typing import Any

from gradysim.results.files import is_run_file
from gradysim.results.pack import PACKS, packed_texts, packs_of
from python.torture.bad_disk import FAULTS, POWER, SIGNALS, BadDisk, Done
from python.torture.study import OUT, content_of_file, content_of_result, prepare

_ALL_FILES = ("--scalars", "--vectors", "all", "--replay", "all", "--pcap", "nodes[0]")
_RUN = ("run", "study.ini", "--quiet", "-r", "0", "--result-dir", OUT, *_ALL_FILES)
_OLD, _NEW = ("--set", "sim-time-limit=1s"), ("--set", "sim-time-limit=2s")
_MANY = ("run", "study.ini", "--quiet", "-r", "0,2,4", "--result-dir", OUT, *_NEW)
_TWO = ("run", "study.ini", "--quiet", "-r", "0,2", "--result-dir", OUT, *_NEW, *_ALL_FILES, "--json")
_PACK = ("pack", OUT, "--remove")
_UNPACK = ("pack", OUT, "--unpack", "--remove")
_PLOT = ("plot", OUT, "--x", "$nodes", "--y", "events", "-o", f"{OUT}/figure.svg")
_VERIFY = ("verify", OUT)
_VIEW = ("view", f"{OUT}/General-#0.integrated.html", "--no-browser")

_CAPTURE = "-nodes[0].pcap"

_AT_ONCE = 2
"""Calls of one row of `make torture`, until the others have their turn."""

_NO_CALL = 2**40
"""More calls than a command makes."""

_MOST_LINES_AFTER_SIGNAL = 3
"""An empty one, that the command stops, and which runs it leaves."""


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
    "run": Case([], _TWO, (*_TWO, "--resume")),
    "run --replace": Case(
        [(*_RUN, *_OLD)], (*_RUN, *_NEW, "--replace"), (*_RUN, *_NEW, "--resume", "--replace")
    ),
    "run --resume": Case([(*_RUN, *_NEW)], (*_RUN, *_NEW, "--resume"), (*_RUN, *_NEW, "--resume"), "*.html"),
    "pack": Case([_MANY], _PACK, _PACK),
    "pack --unpack": Case([_MANY, _PACK], _UNPACK, _UNPACK),
    "plot": Case([_MANY], _PLOT, _PLOT),
    "verify": Case([_MANY, _PACK, (*_RUN, *_NEW)], _VERIFY, _VERIFY),
    "view": Case([(*_RUN, *_NEW)], _VIEW, _VIEW),
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
            self._check_told(done, fault)
            states = self._disk.after_power_failure(self._folder) if fault == POWER else [None]
            for _ in states:
                self._check_state(done, fault)
        except BaseException as failure:
            failure.add_note(f"{' '.join(self._case.command)}: {fault} at call {at}: {done}")
            raise
        return done

    def _check_state(self, done: Done, fault: str) -> None:
        """Fail if a result is lost, or the command, repeated, does not complete its work."""
        found = _content(self._folder / OUT)
        for name in found:
            assert self._is_old_or_new(name, found), name
        for name in [] if done.error_output else _told_complete(done.output):
            for each in (name, *self._new[name]["output_hashes"]):
                assert found.get(each) == self._new[each], each
        if done.code == 0 and fault != POWER:
            assert found == self._new
        elif done.code == 0:  # old names may come back
            assert found.items() >= self._new.items()
        else:
            self._check_kept(found)
        again = self._disk.run(self._folder, self._case.again)
        assert again.code == 0, again
        assert _content(self._folder / OUT) == self._new

    def _is_old_or_new(self, name: str, found: dict[str, Any]) -> bool:
        """Return whether a file is as before or as after the command, or of the result of a run under way.

        A result is written before the other files of its run, and again with their hashes. It is marked as
        interrupted if the run was, or lacks a capture or a replay.
        """
        content, old, new = found[name], self._old.get(name), self._new.get(name)
        if content in (old, new):
            return True
        stem = name.removesuffix(_CAPTURE).rpartition(".integrated.")[0] or name.removesuffix(_CAPTURE)
        result = found.get(f"{stem}.integrated.json", {})
        if result.get("interrupted"):
            return old is None
        return isinstance(new, dict) and content == {**new, "output_hashes": {}}

    def _check_told(self, done: Done, fault: str) -> None:
        lines = done.error_output.splitlines()
        assert "Traceback" not in done.error_output
        if fault in ("KILL", POWER):
            assert done.code in (0, 1, -signal.SIGKILL)
        elif fault in SIGNALS:
            assert done.code in (0, 128 + SIGNALS[fault], -SIGNALS[fault])
            assert len(lines) <= _MOST_LINES_AFTER_SIGNAL
        elif done.code:
            assert done.code in (1, 2)
            named = [line for line in (*lines, *done.output.splitlines()) if f"{OUT}/" in line]
            named += [line for line in lines if line.startswith(f"{OUT}: ")]
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


def _told_complete(output: str) -> list[str]:
    """Return the names of results that a command with --json has reported as complete."""
    results = [json.loads(line) for line in output.splitlines() if line.startswith("{")]
    return [
        f"{result['config']}-#{result['run']}.{result['mode']}.json"
        for result in results
        if not result["interrupted"]
    ]


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


def once(random: Random, folder: Path, name: str, fault: str) -> int:
    """Check a command with a fault at some of its calls; return their number."""
    with BadDisk(OUT) as disk:
        bench = Bench(name, folder, disk)
        count = bench.calls(fault)
        calls = random.sample(range(1, count + 1), min(count, _AT_ONCE))
        for at in calls:
            bench.check(fault, at)
    return max(len(calls), 1)  # `plot` takes no lock


ONCE: dict[str, Callable[[Random, Path], int]] = {
    f"{name}: {fault}": partial(once, name=name, fault=fault) for name in CASES for fault in FAULTS
}
