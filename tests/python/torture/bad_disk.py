"""Commands on a disk where a system call fails: `bad_disk.c`, below Python, SQLite and the engine.

A process has the library preloaded and all modules imported. It is forked for each command, since starting
Python takes longer than most commands.

After a power failure, a file has the content of its last sync. A directory has either the entries of its last
sync, which is all that POSIX promises, or all entries, as ext4 may leave it after a rename.
"""

import gc
import importlib
import json
import mmap
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import traceback
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Self

from python.processes import session, wait_until

_SOURCE = Path(__file__).with_suffix(".c")

SIGNALS = {name: signal.Signals[f"SIG{name}"] for name in ("INT", "TERM", "HUP")}
"""Faults that send a signal to the command while the call waits."""

POWER = "POWER"

FAULTS = ("EIO", "EINTR", "ENOSPC", "ENOLCK", "SHORT", "KILL", POWER, *SIGNALS)
"""As `bad_disk.c` explains them, and the signals."""

ENDS_WITHIN_S = 10.0
"""Wall time from a signal to the end of the command, and from there to its last process, in seconds.

Usually 0.1; longer on a busy machine.
"""

_COUNTS = struct.Struct("@LLL")
_IMPORTED = (
    *("gradysim._netsim", "gradysim.integrated.run", "gradysim.integrated.network_lint", "sqlite3"),
    *("gradysim.cli.app", "gradysim.cli.workers", "gradysim.cli.run_all", "gradysim.cli.progress"),
    *("gradysim.execution.packing", "gradysim.plots", "gradysim.cli.plot", "matplotlib.font_manager"),
    "matplotlib.backends.backend_svg",
)


@dataclass(frozen=True)
class Done:
    """A command that has ended.

    Attributes:
        code: Its exit code; the negative number of the signal that killed it.
        output: What it printed to standard output.
        error_output: What it printed to standard error.
        calls: Number of calls that have the fault.
        failed: Number of those that failed.
    """

    code: int
    output: str = field(repr=False)  # it is long
    error_output: str
    calls: int
    failed: int


class BadDisk:
    """Runs commands one after the other. Their directories called `below` are on the bad disk."""

    def __init__(self, below: str) -> None:
        """Build the library and start the process. Needs Linux and a C compiler."""
        self._below = below
        self._files = tempfile.TemporaryDirectory()
        self._kept = Path(self._files.name, "kept")
        library, counts = (Path(self._files.name, name) for name in ("bad_disk.so", "counts"))
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", library, _SOURCE, "-ldl"], check=True)
        counts.write_bytes(bytes(_COUNTS.size))
        environment = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join(sys.path),
            "LD_PRELOAD": str(library),
            "BAD_DISK_COUNT": str(counts),
        }
        self._process = subprocess.Popen(
            [sys.executable, "-m", "python.torture.bad_disk"],
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._process.communicate()
        self._files.cleanup()

    def run(self, folder: Path, arguments: Sequence[str], fault: str = "", at: int = 0) -> Done:
        """Run `gradysim` in a directory with these arguments, with a fault at a call, counted from 1."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        variables = {
            "BAD_DISK_BELOW": f"{(folder / self._below).resolve()}/",
            "BAD_DISK_FAULT": "PAUSE" if fault in SIGNALS else fault,
            "BAD_DISK_AT": str(at),
        }
        if fault == POWER:
            shutil.rmtree(self._kept, ignore_errors=True)
            self._kept.mkdir()
            variables["BAD_DISK_KEPT"] = str(self._kept)
        print(
            json.dumps([str(folder), arguments, variables, SIGNALS.get(fault, 0)]),
            file=self._process.stdin,
            flush=True,
        )
        return Done(**json.loads(self._process.stdout.readline()))

    def after_power_failure(self, folder: Path) -> Iterator[None]:
        """Put each of two states of the disk in its place that a power failure may leave."""
        directory = folder / self._below
        with tempfile.TemporaryDirectory() as name:
            images = [Path(name, "strict"), Path(name, "all names")]
            self._restore(directory.stat().st_ino, images[0])
            shutil.copytree(directory, images[1], copy_function=self._restore_content_of)
            for image in images:
                shutil.rmtree(directory)
                shutil.move(image, directory)
                yield

    def _restore(self, directory: int, to: Path) -> None:
        """Make a directory, by its inode, with its entries of the last sync."""
        to.mkdir()
        names = self._kept / f"{directory}.names"
        for line in names.read_text().splitlines() if names.exists() else ():
            inode, is_directory, name = line.split(" ", 2)
            if is_directory == "1" and name not in (".", ".."):
                self._restore(int(inode), to / name)
            elif is_directory == "0":
                self._restore_content(int(inode), to / name)

    def _restore_content_of(self, file: str, to: str) -> None:
        self._restore_content(Path(file).stat().st_ino, Path(to))

    def _restore_content(self, inode: int, to: Path) -> None:
        kept = self._kept / str(inode)
        if kept.exists():
            shutil.copy2(kept, to)
        else:
            to.touch()


def _serve() -> None:
    """Fork a process for each line of standard input, and print how it ended."""
    for name in _IMPORTED:
        importlib.import_module(name)
    gc.freeze()
    with open(os.environ["BAD_DISK_COUNT"], "r+b") as file:
        counts = mmap.mmap(file.fileno(), _COUNTS.size)
    for line in sys.stdin:
        request = json.loads(line)
        counts[:] = bytes(_COUNTS.size)
        *command, number = request
        with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
            pid = os.fork()
            if pid == 0:
                _become_command(output.fileno(), errors.fileno(), *command)
            status = _end_of(pid, number, counts)
            told = []
            for file in (output, errors):
                file.seek(0)
                told.append(file.read().decode(errors="replace"))
        calls, failed, _ = _COUNTS.unpack(counts)
        done = Done(os.waitstatus_to_exitcode(status), *told, calls, failed)
        print(json.dumps(asdict(done)), flush=True)


def _end_of(pid: int, number: int, counts: mmap.mmap) -> int:
    """Return how a command ended, to which a signal is sent when a call of it waits."""
    status = None

    def has_ended() -> bool:
        nonlocal status
        found, found_status = os.waitpid(pid, os.WNOHANG)
        status = found_status if found else status
        return bool(found)

    if number:
        wait_until(lambda: has_ended() or _COUNTS.unpack(counts)[1] > 0)
        if status is None:
            os.kill(pid, number)
        counts[-struct.calcsize("@L")] = 1
    if status is None:
        wait_until(has_ended, ENDS_WITHIN_S if number else 60)
    wait_until(lambda: not session(pid), ENDS_WITHIN_S)
    assert status is not None
    return status


def _become_command(
    output: int, errors: int, folder: str, arguments: Sequence[str], variables: Mapping[str, str]
) -> None:
    code = 1
    try:
        os.setsid()
        for number in SIGNALS.values():  # a shell may have ignored them
            signal.signal(number, signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL)
        os.dup2(os.open(os.devnull, os.O_RDWR), 0)
        os.dup2(output, 1)
        os.dup2(errors, 2)
        from gradysim.cli.app import main

        os.chdir(folder)
        os.environ.update(variables)
        os.sync()  # what is there is on the disk
        code = main(arguments)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(code)


if __name__ == "__main__":
    _serve()
