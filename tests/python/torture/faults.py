"""The n-th write, fsync or rename of a run fails, or kills the process: old or new results remain."""

import errno
import os
import signal
from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random
from typing import Any

import pytest

from gradysim.results.durable import finished_name
from python.cli.command import call_gradysim
from python.torture.study import ARGUMENTS, OUT, content_of, prepare

_MOST_CALLS = 25
"""More than a run makes."""

_OLD = ("--set", "sim-time-limit=2s")
_NEW = ("--set", "sim-time-limit=3s")
EARLIER: tuple[tuple[str, ...], ...] = ((), _NEW, _OLD)
"""Settings of the run before: none, the same, others."""

_ONE_RUN = ("-r", "3", "--set", "repeat=2")


class Fault:
    """Replaces a function, and counts its calls in each process."""

    def __init__(self, number: int, kills: bool, code: int) -> None:
        """Fail at the call of that number, counted from 1 over all functions."""
        self._left = number
        self._kills = kills
        self._code = code

    def before(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """Return a function that fails before the call."""

        def called(*arguments: Any, **options: Any) -> Any:
            self._left -= 1
            if self._left == 0:
                self._do()
            return function(*arguments, **options)

        return called

    def in_the_middle(self, write_text: Callable[..., Any]) -> Callable[..., Any]:
        """Return a function that fails after half of the text."""

        def called(path: Path, text: str, **options: Any) -> Any:
            self._left -= 1
            if self._left == 0:
                write_text(path, text[: len(text) // 2], **options)
                self._do()
            return write_text(path, text, **options)

        return called

    def _do(self) -> None:
        if self._kills:
            os.kill(os.getpid(), signal.SIGKILL)
        raise OSError(self._code, os.strerror(self._code))


def once(random: Random, folder: Path) -> int:
    """Inject a fault into one run, without results, with the same, or with those of other settings.

    Return 1.
    """
    number, kills = random.randint(1, _MOST_CALLS), random.random() < 0.5
    do_harm(folder, Fault(number, kills, random.choice([errno.ENOSPC, errno.EIO])), random.choice(EARLIER))
    return 1


def do_harm(folder: Path, fault: Fault, earlier: Sequence[str]) -> bool:
    """Return whether the fault hit a call of the run. `earlier` are settings of an earlier run, if any."""
    prepare(folder)
    command = (*ARGUMENTS, *_ONE_RUN)
    if earlier:
        assert call_gradysim(folder, *command, *earlier).returncode == 0
    old = content_of(folder / OUT) if earlier else {}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "fsync", fault.before(os.fsync))
        patch.setattr(Path, "replace", fault.before(Path.replace))
        patch.setattr(Path, "write_text", fault.in_the_middle(Path.write_text))
        done = call_gradysim(folder, *command, *_NEW, "--replace")
    assert done.returncode in (0, 1, 2)
    found = {name: content for name, content in content_of(folder / OUT).items() if not finished_name(name)}
    resumed = call_gradysim(folder, *command, *_NEW, "--resume", "--replace")
    assert resumed.returncode == 0, resumed.stderr
    new = content_of(folder / OUT)
    assert len(new) == 7
    for name, content in found.items():
        assert name in new, name
        assert content in (old.get(name), new[name]) or is_new_without_hashes(content, new[name]), name
    assert found.keys() >= {name for name in old if name.endswith(".json")}
    if earlier != _OLD:  # these have the same content
        assert found.keys() >= old.keys()
    return done.returncode != 0


def is_new_without_hashes(content: Any, new: Any) -> bool:
    """Return whether a result was written, but not yet again with the names of the other files."""
    return isinstance(new, dict) and content == {**new, "output_hashes": {}}
