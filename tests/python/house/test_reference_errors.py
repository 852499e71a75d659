"""docs/reference/errors.md has the exit codes, messages and exceptions of the code."""

import ast
import importlib
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from gradysim.cli import errors

PAGE = "docs/reference/errors.md"
PACKAGE = Path("python/gradysim")
ENTRY = re.compile(r"^- \*\*`(\w+)`\*\* \(`([\w.]+)`\):", re.MULTILINE)
INTERNAL = {
    "WorkerError",
    "WorkersLostError",
    "RunLockedError",
    "BadValue",
    "BeingLoadedError",
    "NoSuchNodeError",
}
"""Exceptions that do not reach users of the API: the command reports them, or they become others."""


@pytest.fixture
def page(root: Path) -> str:
    return (root / PAGE).read_text(encoding="utf-8")


def declared_exceptions(root: Path) -> Iterator[tuple[str, str]]:
    """The name and the module of each public exception of the package."""
    known = {"Exception", "ValueError", "RuntimeError", "ImportError"}
    classes = [
        (
            statement,
            ".".join(file.relative_to(root / "python").with_suffix("").parts).removesuffix(".__init__"),
        )
        for file in sorted((root / PACKAGE).rglob("*.py"))
        for statement in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(statement, ast.ClassDef) and not statement.name.startswith("_")
    ]
    while (
        new := {node.name for node, _ in classes if known & {ast.unparse(base) for base in node.bases}}
        - known
    ):
        known |= new
    return ((node.name, module) for node, module in classes if node.name in known)


def test_the_exit_codes_are_those_of_the_command(page: str) -> None:
    shown = re.findall(r"^\| (\d+) \| (?:`(\w+)`)? ?\|", page, re.MULTILINE)
    declared = {
        (str(code), name) for name, code in vars(errors).items() if name.isupper() and isinstance(code, int)
    }
    signals = {(str(128 + number), "") for number in (signal.SIGTERM, signal.SIGHUP)}
    assert set(shown) == declared | signals


def test_the_messages_are_golden(root: Path, page: str) -> None:
    golden = (root / "tests/golden/messages.txt").read_text(encoding="utf-8")
    examples = re.findall(r"^```text\n(.*\n    test\.ini:(?:.*\n)+?)```", page, re.MULTILINE)
    assert len(examples) == 5
    one_line = " ".join(golden.split())
    assert [example for example in examples if " ".join(example.split()) not in one_line] == []


def test_every_exception_of_the_package_has_an_entry(root: Path, page: str) -> None:
    shown = ENTRY.findall(page)
    assert {name for name, _ in shown} == {name for name, _ in declared_exceptions(root)} - INTERNAL


def test_the_exceptions_can_be_imported_from_there(page: str) -> None:
    for name, module in ENTRY.findall(page):
        assert issubclass(getattr(importlib.import_module(module), name), Exception)


def test_the_script_prints_what_is_shown(
    code_blocks: Callable[[str, str], list[str]], shows: Callable[..., None], tmp_path: Path
) -> None:
    (script,) = code_blocks(PAGE, "python")
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=tmp_path, check=True, capture_output=True, text=True
    )
    shows(PAGE, done.stdout, -1)
