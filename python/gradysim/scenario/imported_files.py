"""The files that a Python file consists of: itself, and what it imports from its own folder.

Results have their hashes, which tell `--resume` that a protocol has changed. Imports are read from the
source, so that those inside of functions count, and modules that were loaded before.
"""

import ast
import warnings
from collections.abc import Iterator
from pathlib import Path

_INSTALLED = ("site-packages", "dist-packages")
"""Folders of many packages. Only files of the package that was asked for count there."""


def imported_files(file: Path, root: Path) -> tuple[Path, ...]:
    """Return `file` and all files below `root` that it imports, directly or not.

    `root` is the folder that absolute imports start from. Packages between `root` and the files count, too. A
    file that cannot be read or parsed imports nothing.
    """
    package = file.relative_to(root).parts[:-1]
    own = root / file.relative_to(root).parts[0] if root.name in _INSTALLED else root
    found = dict.fromkeys((file, *_files_of_module(package, root)))
    unread = list(found)
    while unread:
        for imported in _direct_imports(unread.pop(), root):
            if imported not in found and imported.is_relative_to(own):
                found[imported] = None
                unread.append(imported)
    return tuple(found)


def root_of_module(name: str, file: Path) -> Path:
    """Return the folder that the module `name` of that file is imported from."""
    depth = name.count(".") + (file.name == "__init__.py")
    return file.parents[depth] if depth < len(file.parents) else file.parent


def _direct_imports(file: Path, root: Path) -> Iterator[Path]:
    try:
        with warnings.catch_warnings():  # about the code, which Python shows when it loads the file
            warnings.simplefilter("ignore")
            tree = ast.parse(file.read_bytes())
    except (OSError, ValueError, SyntaxError, RecursionError, MemoryError):
        return
    for statement in ast.walk(tree):
        if isinstance(statement, ast.Import):
            for alias in statement.names:
                yield from _files_of_module(alias.name.split("."), root)
        elif isinstance(statement, ast.ImportFrom):
            folder = file.parents[statement.level - 1] if 0 < statement.level <= len(file.parents) else root
            if folder.is_relative_to(root):
                module = statement.module.split(".") if statement.module else []
                for alias in statement.names:  # which may be modules, too
                    names = [*folder.relative_to(root).parts, *module, alias.name]
                    yield from _files_of_module(names, root)


def _files_of_module(names: list[str] | tuple[str, ...], root: Path) -> Iterator[Path]:
    """Yield the files of a module and of the packages around it, as far as they are below `root`."""
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
