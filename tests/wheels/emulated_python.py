"""Python for another architecture: that of Debian under QEMU. Nothing is installed on this machine."""

import subprocess
from pathlib import Path

DEBIAN_NAMES = {"x86_64": "amd64", "aarch64": "arm64"}


def unpack_python(architecture: str, directory: Path) -> Path:
    """Download and unpack Debian's Python for an architecture; return its command, such as `…/python3.11`."""
    root = directory / "root"
    if not root.exists():
        for part in ("lists/partial", "archives/partial"):
            (directory / part).mkdir(parents=True, exist_ok=True)
        no_packages = directory / "status"
        no_packages.touch()
        options = {
            "APT::Architecture": DEBIAN_NAMES[architecture],
            "APT::Architectures": DEBIAN_NAMES[architecture],
            "Dir::State::status": no_packages,
            "Dir::State::lists": directory / "lists",
            "Dir::Cache": directory,
            "Dir::Cache::archives": directory / "archives",
        }
        apt = ["apt-get", "-qq", *(f"-o{name}={value}" for name, value in options.items())]
        subprocess.run([*apt, "update"], check=True)
        packages = ["--no-install-recommends", "python3"]
        subprocess.run([*apt, "install", "--yes", "--download-only", *packages], check=True)
        for package in (directory / "archives").glob("*.deb"):
            subprocess.run(["dpkg", "-x", package, root], check=True)
    return (root / "usr/bin/python3").resolve()


def emulated(architecture: str, python: Path) -> list[str | Path]:
    """Return the command that starts a Python that was unpacked."""
    return [f"qemu-{architecture}-static", "-L", python.parents[2], python]
