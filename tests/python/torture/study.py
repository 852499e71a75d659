"""A study with all kinds of files, and its undisturbed results."""

import json
import os
import sqlite3
import subprocess
import sys
import tempfile
import time
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

from gradysim.results.files import is_run_file
from python.processes import session, wait_until

OUT = "out"

_PROTOCOL = """
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand

class Talker(IProtocol):
    heard = 0

    def initialize(self):
        self.provider.schedule_timer("talk", 0.01 * (1 + self.provider.get_id()))

    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand(f"{self.provider.random.random()}"))
        self.provider.schedule_timer("talk", self.provider.current_time() + 0.1)

    def handle_packet(self, message):
        self.heard += 1
        self.provider.tracked_variables["heard"] = self.heard

    def handle_telemetry(self, telemetry): ...
    def finish(self): ...
"""

_INI = """
[General]
sim-time-limit = 100s
repeat = 2
*.numNodes = ${nodes=2, 3, 4}
*.nodes[*].protocol.class = "talker.py:Talker"
*.nodes[*].mobility.lineStepX = 10m
"""

ARGUMENTS = (
    *("run", "study.ini", "--quiet", "--result-dir", OUT),
    *("--scalars", "--vectors", "all", "--replay", "all", "--pcap", "all"),
)

COSTS = {"wall_s", "cpu_s", "setup_s", "checksum"}
"""Fields of result files that differ between two runs, with the hashes of files for OMNeT++."""

_COSTS_OF_OMNETPP = {"wallTime", "cpuTime", "setupTime"}
_IDENTITY = {"datetime", "datetimef", "processid"}
"""Attributes of runs that differ between two runs."""


def prepare(folder: Path) -> None:
    """Write the study's files."""
    (folder / "talker.py").write_text(_PROTOCOL)
    (folder / "study.ini").write_text(_INI)


def begin(folder: Path, *more: str) -> subprocess.Popen[str]:
    """Start the command in a separate session."""
    return subprocess.Popen(
        [sys.executable, "-m", "gradysim", *ARGUMENTS, *more],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def end_of(process: subprocess.Popen[str], seconds: float = 60.0) -> int:
    """Return the exit code after the end of all processes of the command."""
    process.communicate(timeout=seconds)
    wait_until(lambda: not session(process.pid), 5)
    return process.returncode


@cache
def undisturbed() -> tuple[dict[str, Any], float]:
    """Return the content of all files of the study, and the wall time of its command in seconds."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        prepare(folder)
        began = time.monotonic()
        assert end_of(begin(folder)) == 0
        return content_of(folder / OUT), time.monotonic() - began


def content_of(directory: Path) -> dict[str, Any]:
    """Return the common content of two runs, for each file."""
    return {file.name: content_of_file(file) for file in directory.iterdir()}


def content_of_file(file: Path) -> Any:
    """Return the content of a file without what differs between two runs."""
    if is_run_file(file.name):
        return content_of_result(file.read_bytes())
    return _rows(file) if file.suffix in (".sca", ".vec") else file.read_bytes()


def content_of_result(text: bytes) -> dict[str, Any]:
    """Return the content of a file of results without what differs between two runs."""
    content = json.loads(text)
    hashes = content["output_hashes"]
    kept = {name: hashes[name] for name in hashes if Path(name).suffix not in (".sca", ".vec")}
    return {**{name: content[name] for name in content if name not in COSTS}, "output_hashes": kept}


def _rows(file: Path) -> dict[str, list[Any]]:
    connection = sqlite3.connect(f"{file.as_uri()}?mode=ro", uri=True)
    try:
        tables = [
            name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")
        ]
        rows = {table: connection.execute(f"SELECT * FROM {table}").fetchall() for table in tables}
    finally:
        connection.close()
    rows["run"] = []
    rows["runAttr"] = [row for row in rows["runAttr"] if row[1] not in _IDENTITY]
    rows["scalar"] = [row for row in rows["scalar"] if row[3] not in _COSTS_OF_OMNETPP]
    return rows


def assert_resume_completes(folder: Path, random: Random) -> None:
    """Resume the study, and check that each file is as if it had not been disturbed."""
    expected, _ = undisturbed()
    process = begin(folder, "--resume", "--jobs", str(random.randint(1, 3)))
    _, error_output = process.communicate(timeout=60)
    assert process.returncode == 0, error_output
    found = content_of(folder / OUT)
    assert found.keys() == expected.keys(), found.keys() ^ expected.keys()
    for name, content in expected.items():
        assert found[name] == content, name
