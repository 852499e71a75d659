"""The files that a Python file consists of: itself, and what it imports from its own folder.

They are found in the text, imports inside of functions included, and without running anything: which modules
are loaded already, and by whom, makes no difference.
"""

import ast
from collections.abc import Iterator
from pathlib import Path

from gradysim.scenario.protocol.python_text import parsed_python

_INSTALLED = ("site-packages", "dist-packages")
"""Folders of many packages, of which only the one that was asked for is of interest."""


def files_of_python(file: Path, root: Path) -> tuple[Path, ...]:
    """Return `file` and all files below the folder `root` that it imports, or that these import.

    `root` is the folder that imports are seen from, and packages between it and the file are imported, too.
    Where packages are installed, only those of the file's own package count. A file that cannot be read, or
    is no Python, imports nothing.
    """
    found = dict.fromkeys((file, *_files_on_the_way(list(file.relative_to(root).parts[:-1]), root)))
    waiting = list(found)
    own = root / file.relative_to(root).parts[0] if root.name in _INSTALLED else root
    while waiting:
        for imported in _imported_files(waiting.pop(), root):
            if imported not in found and imported.is_relative_to(own):
                found[imported] = None
                waiting.append(imported)
    return tuple(found)


def root_of_module(name: str, file: Path) -> Path:
    """Return the folder that the module `name` of that file is imported from."""
    depth = name.count(".") + (file.name == "__init__.py")
    return file.parents[depth] if depth < len(file.parents) else file.parent


def _imported_files(file: Path, root: Path) -> Iterator[Path]:
    try:
        tree = parsed_python(file.read_bytes())
    except (OSError, ValueError, SyntaxError, RecursionError, MemoryError):
        return
    for statement in ast.walk(tree):
        if isinstance(statement, ast.Import):
            for alias in statement.names:
                yield from _files_on_the_way(alias.name.split("."), root)
        elif isinstance(statement, ast.ImportFrom):
            package = [] if statement.level == 0 else _package(file, root, statement.level)
            if package is not None:
                module = [*package, *(statement.module.split(".") if statement.module else [])]
                for alias in statement.names:  # which may be modules, too
                    yield from _files_on_the_way([*module, alias.name], root)


def _package(file: Path, root: Path, level: int) -> list[str] | None:
    """Return the names of the package that a relative import is seen from; None outside of `root`."""
    folder = file.parents[level - 1] if level <= len(file.parents) else None
    if folder is None or not folder.is_relative_to(root):
        return None
    return list(folder.relative_to(root).parts)


def _files_on_the_way(names: list[str], root: Path) -> Iterator[Path]:
    """The files of a module and of the packages around it, as far as there are any below `root`."""
    folder = root
    for name in names:
        package, module = folder / name / "__init__.py", folder / f"{name}.py"
        if package.is_file():
            yield package
        elif module.is_file():
            yield module
            return
        folder /= name
        if not folder.is_dir():
            return
