"""The project's directory, its files, and the snippets of its documents."""

import importlib
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from python.shown_output import REWRITE, check_block

_ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="session")
def root() -> Path:
    """The project's directory."""
    return _ROOT


@pytest.fixture(scope="session")
def project_files(root: Path) -> Callable[..., list[Path]]:
    """`project_files(".py", ".ini")`: the files that git tracks or would track, relative to the root.

    Without a suffix, all of them.
    """
    listing = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=root,
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    files = [Path(name) for name in sorted(set(listing.split("\0"))) if name and (root / name).is_file()]

    def with_suffix(*suffixes: str) -> list[Path]:
        return [file for file in files if not suffixes or file.suffix in suffixes]

    return with_suffix


@pytest.fixture(scope="session")
def code_blocks(root: Path) -> Callable[[str, str], list[str]]:
    """`code_blocks("docs/how-to/migrate-from-0.8.md", "python")`: the blocks of a language, at least one."""

    def blocks(document: str, language: str) -> list[str]:
        text = (root / document).read_text()
        found: list[str] = re.findall(rf"^```{language}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
        assert found
        return found

    return blocks


@pytest.fixture
def imported(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[Path], Any]]:
    """`imported(file)`: a document's script as a module; afterwards it and its neighbors are forgotten."""
    folders: set[Path] = set()

    def load(file: Path) -> Any:
        monkeypatch.syspath_prepend(file.parent)
        folders.add(file.parent)
        return importlib.import_module(file.stem)

    yield load
    for name, module in list(sys.modules.items()):
        if Path(getattr(module, "__file__", None) or "").parent in folders:
            del sys.modules[name]


@pytest.fixture
def shell(root: Path, tmp_path: Path) -> Callable[[str, Path], str]:
    """`shell(commands, folder)`: output of commands that run there, with the project's `gradysim`."""
    pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")
    program = tmp_path / "bin" / "gradysim"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m gradysim "$@"\n')
    program.chmod(0o755)
    variables = {**os.environ, "PATH": f"{program.parent}{os.pathsep}{os.environ['PATH']}"}
    variables["PYTHONPATH"] = str(root / "python")
    variables.pop("COLUMNS", None)  # pytest-xdist sets it; pages show output of any width

    def run(commands: str, folder: Path) -> str:
        return subprocess.run(
            ["bash", "-euc", commands],
            cwd=folder,
            env=variables,
            check=True,
            stdout=subprocess.PIPE,
            text=True,
        ).stdout

    return run


@pytest.fixture
def clone(root: Path, tmp_path: Path) -> Path:
    """Return a directory with the configurations and examples of the project, for commands that write."""
    for name in ("configs", "examples"):
        (tmp_path / name).symlink_to(root / name)
    return tmp_path


@pytest.fixture
def swarm(shell: Callable[[str, Path], str], tmp_path: Path) -> Path:
    """Return a directory with `swarm`, the project of several guides, made by `gradysim new`."""
    shell("gradysim new swarm", tmp_path)
    return tmp_path


@pytest.fixture
def saved(
    code_blocks: Callable[[str, str], list[str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[..., Path]:
    """`saved(document, python="a.py", ini="a.ini")`: the document's files as a reader would save them.

    Returns their folder, which is the working directory.
    """

    def save(document: str, **names: str) -> Path:
        for language, name in names.items():
            (tmp_path / name).write_text("\n\n".join(code_blocks(document, language)), encoding="utf-8")
        monkeypatch.chdir(tmp_path)
        return tmp_path

    return save


@pytest.fixture
def climbers(
    code_blocks: Callable[[str, str], list[str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[[str, str], Path]:
    """`climbers(document, "watch.py")`: a guide's script with this name, its `climber.py` and `watch.ini`.

    Returns their folder, which is the working directory.
    """

    def save(document: str, name: str) -> Path:
        first, climber, *others = code_blocks(document, "python")
        (tmp_path / "climber.py").write_text(climber, encoding="utf-8")
        (tmp_path / name).write_text("\n\n".join([first, *others]), encoding="utf-8")
        (tmp_path / "watch.ini").write_text(code_blocks(document, "ini")[0], encoding="utf-8")
        monkeypatch.chdir(tmp_path)
        return tmp_path

    return save


@pytest.fixture
def shows(root: Path) -> Callable[..., None]:
    """`shows(page, printed, 1)`: the second `text` block of the page is what was printed.

    A line `…` stands for lines that are left out. With `part=True` the block is some lines in a row, with
    `changing=True` processor times and hashes may differ, and with `terminal=True` long lines are
    broken. `make pages` rewrites blocks that differ.
    """

    def check(page: str, printed: str, number: int = 0, **how: Any) -> None:
        check_block(root / page, printed, number, **how)

    return check


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """With `make pages`, run only the tests of shown output."""
    if REWRITE:
        others = [item for item in items if "shows" not in getattr(item, "fixturenames", ())]
        config.hook.pytest_deselected(items=others)
        items[:] = [item for item in items if item not in others]
