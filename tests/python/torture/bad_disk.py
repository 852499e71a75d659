"""Commands on a disk where a system call fails: `bad_disk.c`, below Python, SQLite and the engine.

A process has the library preloaded and all modules imported. It is forked for each command, since starting
Python takes longer than most commands.
"""

import gc
import importlib
import json
import mmap
import os
import struct
import subprocess
import sys
import tempfile
import traceback
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Self

from python.processes import session, wait_until

_SOURCE = Path(__file__).with_suffix(".c")

FAULTS = ("EIO", "EINTR", "ENOSPC", "ENOLCK", "SHORT", "KILL")
"""As `bad_disk.c` explains them."""

_COUNTS = struct.Struct("@LL")
_IMPORTED = (
    *("gradysim._netsim", "gradysim.integrated.run", "gradysim.integrated.network_lint", "sqlite3"),
    *("gradysim.cli.app", "gradysim.cli.group_executor", "gradysim.cli.run_all", "gradysim.cli.progress"),
    *("gradysim.results.packing", "gradysim.plots", "gradysim.cli.plot", "matplotlib.font_manager"),
    "matplotlib.backends.backend_svg",
)


@dataclass(frozen=True)
class Done:
    """A command that has ended.

    Attributes:
        code: Its exit code; the negative number of the signal that killed it.
        error_output: What it printed to standard error.
        calls: Number of calls that have the fault.
        failed: Number of those that failed.
    """

    code: int
    error_output: str
    calls: int
    failed: int


class BadDisk:
    """Runs commands one after the other. Their directories called `below` are on the bad disk."""

    def __init__(self, below: str) -> None:
        """Build the library and start the process. Needs Linux and a C compiler."""
        self._below = below
        self._files = tempfile.TemporaryDirectory()
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
            "BAD_DISK_FAULT": fault,
            "BAD_DISK_AT": str(at),
        }
        print(json.dumps([str(folder), arguments, variables]), file=self._process.stdin, flush=True)
        return Done(**json.loads(self._process.stdout.readline()))


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
        with tempfile.TemporaryFile() as errors:
            pid = os.fork()
            if pid == 0:
                _become_command(errors.fileno(), *request)
            _, status = os.waitpid(pid, 0)
            wait_until(lambda leader=pid: not session(leader))  # type: ignore[misc]
            errors.seek(0)
            told = errors.read().decode(errors="replace")
        done = Done(os.waitstatus_to_exitcode(status), told, *_COUNTS.unpack(counts))
        print(json.dumps(asdict(done)), flush=True)


def _become_command(errors: int, folder: str, arguments: Sequence[str], variables: Mapping[str, str]) -> None:
    code = 1
    try:
        os.setsid()
        os.dup2(os.open(os.devnull, os.O_RDWR), 0)
        os.dup2(0, 1)
        os.dup2(errors, 2)
        from gradysim.cli.app import main

        os.chdir(folder)
        os.environ.update(variables)
        code = main(arguments)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(code)


if __name__ == "__main__":
    _serve()
