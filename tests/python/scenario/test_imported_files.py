from pathlib import Path

import pytest

from gradysim.scenario.schema.protocols import imported_files, root_of_module


def files(root: Path, **texts: str) -> set[str]:
    """Write files, `a__b` for a/b.py, and return the names of the files of main.py."""
    for name, text in texts.items():
        file = root / f"{name.replace('__', '/')}.py"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    return names(root, imported_files(root / "main.py", root))


def names(root: Path, found: tuple[Path, ...]) -> set[str]:
    return {file.relative_to(root).as_posix() for file in found}


def test_a_file_alone(tmp_path: Path) -> None:
    assert files(tmp_path, main="import json, nothing_there", other="") == {"main.py"}


def test_what_is_imported_counts_with_what_it_imports(tmp_path: Path) -> None:
    found = files(tmp_path, main="import a", a="from b import x", b="import main", other="")
    assert found == {"main.py", "a.py", "b.py"}


def test_imports_inside_of_functions_count(tmp_path: Path) -> None:
    assert files(tmp_path, main="def f():\n    import a", a="") == {"main.py", "a.py"}


def test_modules_of_packages(tmp_path: Path) -> None:
    (tmp_path / "p").mkdir()
    (tmp_path / "p" / "__init__.py").write_text("from .a import x")
    found = files(tmp_path, main="from p import b", p__a="from . import c", p__b="", p__c="", p__d="")
    assert found == {"main.py", "p/__init__.py", "p/a.py", "p/b.py", "p/c.py"}


def test_the_packages_around_a_file_count_with_what_they_import(tmp_path: Path) -> None:
    root, package = tmp_path, tmp_path / "p" / "q"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("from p import a")
    for name in ("a", "b", "q/main"):
        (root / "p" / f"{name}.py").write_text("")
    assert names(root, imported_files(package / "main.py", root)) == {
        "p/q/main.py",
        "p/q/__init__.py",
        "p/a.py",
    }


def test_folders_without_init(tmp_path: Path) -> None:
    assert files(tmp_path, main="import p.q.a", p__q__a="", p__b="") == {"main.py", "p/q/a.py"}


def test_relative_imports_end_at_the_root(tmp_path: Path) -> None:
    (tmp_path.parent / "outside.py").write_text("")
    assert files(tmp_path, main="from .. import outside") == {"main.py"}


@pytest.mark.parametrize("text", ["def", "\0", "\udcff"])
def test_a_file_that_is_not_python_imports_nothing(tmp_path: Path, text: str) -> None:
    (tmp_path / "a.py").write_bytes(text.encode(errors="surrogateescape"))
    assert files(tmp_path, main="import a") == {"main.py", "a.py"}


def test_other_installed_packages_do_not_count(tmp_path: Path) -> None:
    root = tmp_path / "site-packages"
    files(root, p__main="import p.a, other", p__a="", other="")
    assert names(root, imported_files(root / "p" / "main.py", root)) == {"p/main.py", "p/a.py"}


@pytest.mark.parametrize(
    ("module", "file"), [("a", "a.py"), ("a", "a/__init__.py"), ("a.b", "a/b.py"), ("a.b", "a/b/__init__.py")]
)
def test_where_a_module_is_imported_from(module: str, file: str) -> None:
    assert root_of_module(module, Path("/x/y") / file) == Path("/x/y")
