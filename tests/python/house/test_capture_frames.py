"""The output in docs/how-to/capture-frames.md is correct."""

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

needs_tshark = pytest.mark.skipif(shutil.which("tshark") is None, reason="tshark is not installed")


@pytest.fixture
def guide(root: Path) -> str:
    return (root / "docs/how-to/capture-frames.md").read_text()


@pytest.fixture
def folder(guide: str, tmp_path: Path) -> Path:
    """Return the directory of a reader who saved the guide's two files and ran its command."""
    for language, name in [("python", "capture.py"), ("ini", "capture.ini")]:
        (tmp_path / name).write_text(blocks(guide, language)[0])
    program, *arguments = shlex.split(blocks(guide, "sh")[0])
    assert program == "gradysim"
    subprocess.run(
        [sys.executable, "-m", "gradysim", *arguments],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        check=True,
    )
    return tmp_path


def blocks(guide: str, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)


def test_the_files_that_it_names_are_written(guide: str, folder: Path) -> None:
    named = set(re.findall(r"`(results/[^`]*\.pcap)`", guide))
    assert len(named) == 2
    assert {str(file.relative_to(folder)) for file in folder.rglob("*.pcap")} == named


@needs_tshark
def test_tshark_prints_what_it_shows(guide: str, folder: Path, shows: Callable[..., None]) -> None:
    command = shlex.split(blocks(guide, "sh")[1])
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    shows("docs/how-to/capture-frames.md", done.stdout)


@needs_tshark
def test_failed_frames_are_retried_with_their_sequence_number(folder: Path) -> None:
    def sequence_numbers(what: str) -> list[str]:
        file = str(folder / "results/General-#0-groundStation.pcap")
        command = ["tshark", "-r", file, "-Y", what, "-T", "fields", "-e", "wlan.seq"]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()

    failed = sequence_numbers("radiotap.flags.badfcs == 1 && wlan.fc.retry == 0")
    assert failed != []
    assert failed == sequence_numbers("radiotap.flags.badfcs == 0 && wlan.fc.retry == 1")
