"""Build the wheels and the source distribution of gradysim into `dist`: `make wheels`.

Each Python of this machine gets a wheel for each architecture. All other systems get one without the engine.
The compiler comes from the package `ziglang`. It has its own C++ library and links with an old glibc.
So the wheels run on Linux systems since 2018 (manylinux_2_28), and no container is needed.
"""

import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from pythons import ARCHITECTURES, BUILD, DIST, GLIBC, PLATFORM, ROOT, VERSIONS, pythons

HOST = os.uname().machine


def compilers(architecture: str) -> Path:
    """Return a directory with the compilers for an architecture and the tools that belong to them."""
    directory = BUILD / f"zig-{architecture}"
    includes = directory / "include"
    includes.mkdir(parents=True, exist_ok=True)
    # The last option wins: all calls have one kind of -flto. For each kind, ziglang compiles its C++ library,
    # which takes minutes.
    target = f'-target {architecture}-linux-gnu.{GLIBC} -isystem {includes} "$@" -flto=thin'
    for name, command in {"c++": f"c++ {target}", "llvm-ar": 'ar "$@"', "llvm-ranlib": 'ranlib "$@"'}.items():
        tool = directory / name
        tool.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m ziglang {command}\n')
        tool.chmod(0o755)
    # Debian's Python.h includes <ARCHITECTURE-linux-gnu/python3.11/pyconfig.h>. It is the same for both.
    for each in ARCHITECTURES:
        (includes / f"{each}-linux-gnu").unlink(missing_ok=True)
        (includes / f"{each}-linux-gnu").symlink_to(f"/usr/include/{HOST}-linux-gnu")
    return directory


def run_build(python: str, *arguments: str, **variables: str) -> None:
    """Build a distribution for `python`, with the tools of the Python that runs this script.

    The tools must be in one place for all Pythons. Otherwise scikit-build-core compiles everything again.
    """
    command = [python, "-m", "build", "--no-isolation", "--outdir", str(DIST), *arguments]
    tools = {"PYTHONPATH": sysconfig.get_path("purelib")}
    subprocess.run(command, cwd=ROOT, env=os.environ | tools | variables, check=True)


def build_wheel(python: str, version: str, architecture: str) -> None:
    """Build a wheel with the engine. The Pythons share the objects that do not include Python.h."""
    tools = compilers(architecture)
    objects = BUILD / f"objects-{architecture}"
    (objects / "CMakeCache.txt").unlink(missing_ok=True)  # what CMake has found out about another Python
    tag = f"cp{version.replace('.', '')}"
    suffix = f".cpython-{version.replace('.', '')}-{architecture}-linux-gnu.so"
    settings = {
        "build-dir": objects,
        "wheel.tags": f"{tag}-{tag}-{PLATFORM}_{architecture}",
        "cmake.define.PYTHON_MODULE_EXTENSION": suffix,
        "cmake.define.CMAKE_TRY_COMPILE_CONFIGURATION": "Release",
    }
    if architecture != HOST:
        settings["cmake.define.CMAKE_SYSTEM_NAME"] = "Linux"
        settings["cmake.define.CMAKE_SYSTEM_PROCESSOR"] = architecture
    options = [f"-C{name}={value}" for name, value in settings.items()]
    run_build(python, "--wheel", *options, CXX=str(tools / "c++"))


def main() -> None:
    """Build all that the Pythons of this machine allow."""
    found = pythons()
    if missing := [version for version in VERSIONS if version not in found]:
        print(f"No wheels for Python {', '.join(missing)}: not on this machine", flush=True)
    shutil.rmtree(DIST, ignore_errors=True)
    run_build(sys.executable, "--sdist")
    run_build(sys.executable, "--wheel", "-Cwheel.cmake=false", "-Cwheel.py-api=py3")
    for version, python in found.items():
        for architecture in ARCHITECTURES:
            build_wheel(python, version, architecture)


if __name__ == "__main__":
    main()
