"""What wheels are built for: versions of Python, architectures, and the platform."""

import os
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "wheels"
DIST = ROOT / "dist"
VERSIONS = ("3.11", "3.12", "3.13", "3.14")
ARCHITECTURES = ("x86_64", "aarch64")
GLIBC = "2.28"
PLATFORM = f"manylinux_{GLIBC.replace('.', '_')}"


def pythons() -> dict[str, str]:
    """Return {version: command} of the Pythons on this machine that wheels are built for."""
    return {version: python for version in VERSIONS for python in list(candidates(version))[:1]}


def candidates(version: str) -> Iterator[str]:
    """Yield the commands that start a Python of a version: those of pyenv, then that of the `PATH`."""
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    yield from map(str, sorted(pyenv.glob(f"{version}.*/bin/python")))
    # pyenv puts commands of all its versions into the `PATH`; one that is not chosen fails.
    command = shutil.which(f"python{version}")
    if command and subprocess.run([command, "--version"], capture_output=True).returncode == 0:
        yield command
