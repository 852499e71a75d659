"""The imports of the Python packages go one way, and only integrated mode imports the compiled engine."""

import ast
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

ProjectFiles = Callable[..., list[Path]]

PACKAGE = Path("python/gradysim")


def test_import_contracts_hold(root: Path) -> None:
    """The contracts are in pyproject.toml, [tool.importlinter]."""
    outcome = subprocess.run(
        [Path(sys.executable).with_name("lint-imports"), "--no-cache", "--no-logo"],
        cwd=root,
        env=os.environ | {"PYTHONPATH": str(root / "python"), "NO_COLOR": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


def imports_at_run_time(tree: ast.AST) -> Iterator[str]:
    """Yield the modules and names that a source imports, except in `if TYPE_CHECKING:`."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
            continue
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        yield from imports_at_run_time(node)


def test_only_integrated_mode_imports_the_engine(
    root: Path, project_files: Callable[..., list[Path]]
) -> None:
    importers = {
        file.relative_to(PACKAGE).parts[0]
        for file in project_files(".py")
        if file.is_relative_to(PACKAGE)
        for name in imports_at_run_time(ast.parse((root / file).read_text()))
        if name.startswith("gradysim._netsim")
    }
    assert importers <= {"integrated"}


def test_prototype_mode_runs_without_the_compiled_part(root: Path) -> None:
    program = "\n".join(
        [
            "import sys",
            "sys.modules['gradysim._netsim'] = None",  # an import of it now fails
            "import gradysim.cli.app, gradysim.prototype.run, gradysim.simulator.simulation",
        ]
    )
    outcome = subprocess.run(
        [sys.executable, "-c", program],
        cwd=root,
        env=os.environ | {"PYTHONPATH": str(root / "python")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert outcome.returncode == 0, outcome.stderr


def test_contributing_lists_the_packages(root: Path) -> None:
    packages = {file.parent.name for file in (root / "python/gradysim").glob("*/__init__.py")}
    (listed,) = re.findall(
        r"^python/gradysim +(.*?), from the bottom", (root / "CONTRIBUTING.md").read_text(), re.M | re.S
    )
    assert set(re.findall(r"\w+", listed)) == packages
