"""Finds the class that `protocol.class` names, checks that it can run, and lists its files.

Results have the hashes of these files, which tell `--resume` that a protocol has changed. Imports are read
from the source, so that those inside of functions count, and modules that were loaded before.
"""

import ast
import importlib
import inspect
import os
import sys
import traceback
import warnings
from collections.abc import Iterator
from pathlib import Path
from types import FunctionType, ModuleType

from gradysim.protocol.interface import (
    CALLBACKS,
    FAILED_MESSAGE_CALLBACK,
    OPTIONAL_CALLBACKS,
    IProtocol,
    is_protocol_class,
)
from gradysim.scenario.errors import BadValue, nearest, nearest_file
from gradysim.scenario.parse.regular_files import check_regular
from gradysim.scenario.schema.native_protocols import is_native_name
from gradysim.scenario.schema.protocol_modules import BeingLoadedError, ModuleLoader, Origin, remember_origin

_REFERENCE = 'a protocol as "file.py:Class" or "package.module:Class"'
"""Expected where a reference leads to no file or module."""


_INSTALLED = ("site-packages", "dist-packages")
"""Folders of many packages. Only files of the package that was asked for count there."""


class ProtocolLoader:
    """Loads each file and module once for a configuration."""

    def __init__(self) -> None:
        self._modules = ModuleLoader()
        self._files: dict[tuple[Path, Path], tuple[Path, ...]] = {}

    def load(self, reference: str, folder: Path) -> type[IProtocol]:
        """Return the class of "file.py:Class", seen from `folder`, or "package.module:Class".

        Raises:
            BadValue: There is no such file, module or class, it does not load, or it is not a complete
                protocol.
        """
        location, colon, class_name = reference.rpartition(":")
        if not (colon and location and class_name.isidentifier()):
            meant = _class_meant(reference, folder)
            raise BadValue(f"`{reference}` does not name a class", expected=_REFERENCE, suggestion=meant)
        if not _is_file(location):
            return _protocol_in(_import_module(location, folder, class_name), class_name, location)
        protocol = _protocol_in(self._load_file(location, folder), class_name, location)
        remember_origin(protocol, Origin((folder / location).resolve(), class_name, self._modules))
        return protocol

    def files(self, reference: str, folder: Path) -> tuple[Path, ...]:
        """Return the files that the protocol of a reference consists of, once it is loaded."""
        location = reference.rpartition(":")[0]
        if _is_file(location):
            file = (folder / location).resolve()
            root = file.parent
        else:
            file_of_module = getattr(sys.modules.get(location), "__file__", None)
            if file_of_module is None:  # a module that is built in
                return ()
            file = Path(file_of_module).resolve()
            root = root_of_module(location, file)
        if (file, root) not in self._files:
            self._files[file, root] = imported_files(file, root)
        return self._files[file, root]

    def _load_file(self, location: str, folder: Path) -> ModuleType:
        file = folder / location
        try:
            is_file = file.is_file()
        except OSError as error:
            raise BadValue(f"{file}: {error.strerror}") from error
        if not is_file:
            check_regular(file)
            meant = nearest_file(file, (".py",), location)
            raise BadValue(f"there is no file {file}", expected=_REFERENCE, suggestion=meant)
        try:
            return self._modules.load(file)
        except KeyboardInterrupt:
            raise
        except BeingLoadedError as error:
            raise BadValue(
                f"{error}: it reads this configuration when it is imported",
                expected='that below `if __name__ == "__main__":`, or the class as `__main__:Class`',
            ) from error
        except BaseException as error:
            raise BadValue(f"{file} does not load: {_error_text(error, file.parent)}") from error


def _is_file(location: str) -> bool:
    """Return whether the part before the colon is a file rather than a module."""
    return location.endswith(".py") or "/" in location or "\\" in location


def _import_module(name: str, folder: Path, class_name: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{name}.".startswith(f"{error.name}."):
            raise BadValue(f"module {name} does not load: {_error_text(error)}") from error
        file = f"{name.replace('.', '/')}.py"
        meant = f"{file}:{class_name}" if (folder / file).is_file() else ""
        text = f"this Python finds no module `{error.name}`"
        raise BadValue(text, expected=_REFERENCE, suggestion=meant) from error
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        raise BadValue(f"module {name} does not load: {_error_text(error)}") from error


def _protocol_in(module: ModuleType, name: str, location: str) -> type[IProtocol]:
    cls = getattr(module, name, None)
    protocols = [key for key, value in vars(module).items() if is_protocol_class(value)]
    others = f"; there are {', '.join(protocols)}" if protocols else ""
    if cls is None:
        meant = nearest(name, protocols)
        raise BadValue(f"{location} has no class `{name}`", "" if meant else others, suggestion=meant)
    if not is_protocol_class(cls):
        why = "is not a protocol: it does not derive from IProtocol"
        if cls is IProtocol:
            why = "is not a protocol but the interface that protocols derive from"
        raise BadValue(f"`{name}` in {location} {why}", others)
    protocol: type[IProtocol] = cls
    if missing := _missing_callbacks(protocol):
        own = _own_names(protocol)
        alike = [meant for method in missing if (meant := nearest(method, own, strict=True))]
        hint = f"; it has {_calls(alike)}" if alike else ""
        raise BadValue(f"`{name}` in {location} is not complete, it lacks {_calls(missing)}", hint)
    check_contract(protocol)
    return protocol


def _missing_callbacks(protocol: type[IProtocol]) -> list[str]:
    """Return the callbacks that a protocol must define, and optional ones whose name it has misspelled."""
    methods = [key for key in _own_names(protocol) if callable(getattr(protocol, key))]
    left_out = [
        callback
        for callback in (*OPTIONAL_CALLBACKS, FAILED_MESSAGE_CALLBACK)
        if inspect.getattr_static(protocol, callback, None) is vars(IProtocol)[callback]
    ]
    # Names that are longer by more than a letter, such as `finished`, are those of other methods.
    misspelled = [
        callback
        for callback in left_out
        if nearest(callback, [name for name in methods if abs(len(name) - len(callback)) <= 1], strict=True)
    ]
    return sorted([*getattr(protocol, "__abstractmethods__", ()), *misspelled])


def _own_names(protocol: type[IProtocol]) -> list[str]:
    return [key for key in dir(protocol) if not key.startswith("_") and key not in dir(IProtocol)]


def _class_meant(reference: str, folder: Path) -> str:
    """Return what a reference without a colon may mean: another key, or a file and a class; or ""."""
    if is_native_name(reference):
        return "protocol.typename"
    module, _, class_name = reference.rpartition(".")
    file = f"{module.replace('.', '/')}.py"
    is_meant = module and class_name.isidentifier() and class_name != "py" and os.path.isfile(folder / file)
    return f"{file}:{class_name}" if is_meant else ""


def _calls(methods: list[str]) -> str:
    return ", ".join(f"{method}()" for method in methods)


def _error_text(error: BaseException, folder: Path | None = None) -> str:
    """Return what was raised, and the innermost line of the user's own files that led to it."""
    text = "".join(traceback.format_exception_only(error)[-1:]).strip()
    if isinstance(error, SyntaxError) and error.filename and error.lineno:
        return f"{text} ({error.filename}:{error.lineno})" if "line " not in text else text
    frames = [
        frame for frame in traceback.extract_tb(error.__traceback__) if "importlib" not in frame.filename
    ]
    own = [
        frame
        for frame in frames
        if folder is not None and Path(frame.filename).resolve().is_relative_to(folder.resolve())
    ]
    innermost = (own or frames)[-1:]
    return f"{text} ({innermost[0].filename}:{innermost[0].lineno})" if innermost else text


_CALLBACKS = {
    name: tuple(inspect.signature(vars(IProtocol)[name]).parameters)
    for name in (*CALLBACKS, FAILED_MESSAGE_CALLBACK)
}
"""Arguments of the callbacks, with `self`. All are passed by position."""


def check_contract(protocol: type[IProtocol]) -> None:
    """Check that the constructor and the callbacks of a complete protocol can be called.

    Python finds a wrong signature only at the call: in the middle of a run, or never.

    Raises:
        BadValue: A method has other arguments, or its code would not run.
    """
    if vars(IProtocol)["instantiate"] is inspect.getattr_static(protocol, "instantiate"):
        _check_method(protocol, "__init__", ("self",))
    for name, arguments in _CALLBACKS.items():
        if name != FAILED_MESSAGE_CALLBACK or hasattr(protocol, name):
            _check_method(protocol, name, arguments)


def _check_method(protocol: type[IProtocol], name: str, arguments: tuple[str, ...]) -> None:
    method = inspect.getattr_static(protocol, name)
    given = arguments
    if isinstance(method, staticmethod | classmethod):
        method, given = getattr(protocol, name), arguments[1:]
    elif not isinstance(method, FunctionType):
        if hasattr(method, "__get__"):
            return  # only an instance tells what such a descriptor returns
        given = arguments[1:]
    expected = f"`def {name}({', '.join(arguments)})`"
    if not callable(method):
        raise BadValue(f"`{name}` of `{protocol.__name__}` is {method!r}", expected=expected)
    code = getattr(inspect.unwrap(method), "__code__", None)
    where = f"of `{protocol.__name__}`" + (f" ({code.co_filename}:{code.co_firstlineno})" if code else "")
    signature = _signature_of(method)
    try:
        if signature is not None:
            signature.bind(*given)
    except TypeError:
        call = f"with `{', '.join(arguments[1:])}` alone" if arguments[1:] else "without arguments"
        raise BadValue(f"`{name}{signature}` {where} cannot be called {call}", expected=expected) from None
    if inspect.iscoroutinefunction(method) or inspect.isasyncgenfunction(method):
        raise BadValue(f"`{name}` {where} is asynchronous, and nothing would await it", expected=expected)
    if inspect.isgeneratorfunction(method):
        problem = f"`{name}` {where} is a generator, as it has a `yield`, and its code would not run"
        raise BadValue(problem, expected=expected)


def _signature_of(function: object) -> inspect.Signature | None:
    """Return what the function itself takes, not what a decorated one takes; None if nothing tells."""
    if "__signature__" in getattr(function, "__dict__", {}):
        return None  # it is for display
    try:
        return inspect.signature(function, follow_wrapped=False)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return None


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
