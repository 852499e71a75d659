"""Finds the class that `protocol.class` names, and checks that it is a protocol that can run."""

import importlib
import inspect
import os
import sys
import traceback
import uuid
from pathlib import Path
from types import ModuleType

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import BadValue, nearest, nearest_file
from gradysim.scenario.protocol.contract import check_contract
from gradysim.scenario.protocol.imported_files import files_of_python, root_of_module
from gradysim.scenario.protocol.module import BeingLoadedError, ModuleLoader
from gradysim.scenario.protocol.native import is_native_name
from gradysim.scenario.protocol.origin import Origin, remember_origin

_REFERENCE = 'a protocol as "file.py:Class" or "package.module:Class"'
"""Said of a reference that leads to no file or module. In others its form is right."""


class ProtocolLoader:
    """Loads each file and module once for a configuration."""

    def __init__(self, name: str = "", modules: ModuleLoader | None = None) -> None:
        """`name` tells it from other loaders in Origin; it makes one of its own if there is none."""
        self._name = name or uuid.uuid4().hex
        self._modules = modules or ModuleLoader()
        self._files: dict[tuple[Path, Path], tuple[Path, ...]] = {}

    def load(self, reference: str, folder: Path) -> type[IProtocol]:
        """The class of "file.py:Class" (the file relative to `folder`) or "package.module:Class".

        Raises:
            BadValue: There is no such file, module or class, it does not load, or it is no complete protocol.
        """
        place, colon, class_name = reference.rpartition(":")
        if not (colon and place and class_name.isidentifier()):
            meant = _class_meant(reference, folder)
            raise BadValue(f"`{reference}` names no class", expected=_REFERENCE, suggestion=meant)
        if not _is_file(place):
            return _protocol_in(_from_name(place, folder, class_name), class_name, place)
        protocol = _protocol_in(self._from_file(place, folder), class_name, place)
        origin = Origin((folder / place).resolve(), class_name, self._name)
        remember_origin(protocol, origin, self._modules)
        return protocol

    def files(self, reference: str, folder: Path) -> tuple[Path, ...]:
        """The files that the protocol of a reference consists of, once it is loaded."""
        place = reference.rpartition(":")[0]
        if _is_file(place):
            file = (folder / place).resolve()
            root = file.parent
        else:
            file_of_module = getattr(sys.modules.get(place), "__file__", None)
            if file_of_module is None:  # one that is built in
                return ()
            file = Path(file_of_module).resolve()
            root = root_of_module(place, file)
        if (file, root) not in self._files:
            self._files[file, root] = files_of_python(file, root)
        return self._files[file, root]

    def _from_file(self, place: str, folder: Path) -> ModuleType:
        file = folder / place
        try:
            is_file = file.is_file()
        except OSError as error:
            raise BadValue(f"{file}: {error.strerror}") from error
        if not is_file:
            meant = nearest_file(file, (".py",), place)
            raise BadValue(f"there is no file {file}", expected=_REFERENCE, suggestion=meant)
        try:
            return self._modules.load(file)
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            if _is_loaded_by_itself(file, error):
                raise _loaded_by_itself(file, error) from error
            raise BadValue(f"{file} does not load: {_error_text(error, file.parent)}") from error


def _is_file(place: str) -> bool:
    """Whether what stands before the colon is a file, and no module."""
    return place.endswith(".py") or "/" in place or "\\" in place


def _from_name(name: str, folder: Path, class_name: str) -> ModuleType:
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


def _protocol_in(module: ModuleType, name: str, place: str) -> type[IProtocol]:
    cls = getattr(module, name, None)
    if cls is None:
        protocols = _protocols(module)
        meant = nearest(name, protocols)
        hint = "" if meant else _list(protocols)
        raise BadValue(f"{place} has no class `{name}`", hint, suggestion=meant)
    if not _is_protocol(cls):
        why = "is no protocol, it does not derive from IProtocol"
        if cls is IProtocol:
            why = "is no protocol but the interface that protocols derive from"
        raise BadValue(f"`{name}` in {place} {why}", _list(_protocols(module)))
    protocol: type[IProtocol] = cls
    if inspect.isabstract(protocol):
        missing = sorted(protocol.__abstractmethods__)
        raise BadValue(
            f"`{name}` in {place} is not complete, it lacks {_calls(missing)}", _misspelt(protocol, missing)
        )
    check_contract(protocol)
    return protocol


def _class_meant(reference: str, folder: Path) -> str:
    """Return what a reference without a colon may mean: another key, or a file and a class; or ""."""
    if is_native_name(reference):
        return "protocol.typename"
    module, _, class_name = reference.rpartition(".")
    file = f"{module.replace('.', '/')}.py"
    is_meant = module and class_name.isidentifier() and class_name != "py" and os.path.isfile(folder / file)
    return f"{file}:{class_name}" if is_meant else ""


def _misspelt(protocol: type[IProtocol], missing: list[str]) -> str:
    """A hint at methods of the class that look like missing ones."""
    own = [name for name in dir(protocol) if not name.startswith("_") and name not in dir(IProtocol)]
    alike = [name for method in missing if (name := nearest(method, own, strict=True))]
    return f"; it has {_calls(alike)}" if alike else ""


def _calls(methods: list[str]) -> str:
    return ", ".join(f"{method}()" for method in methods)


def _protocols(module: ModuleType) -> list[str]:
    return [name for name, value in vars(module).items() if _is_protocol(value)]


def _is_protocol(value: object) -> bool:
    return isinstance(value, type) and issubclass(value, IProtocol) and value is not IProtocol


def _is_loaded_by_itself(file: Path, error: BaseException | None) -> bool:
    """Whether the error is that this file was loaded again, before it had been to its end."""
    while error is not None and not isinstance(error, BeingLoadedError):
        error = error.__cause__
    return error is not None and error.file == file.resolve()


def _loaded_by_itself(file: Path, error: BaseException) -> BadValue:
    place = "" if isinstance(error, BeingLoadedError) else _place(error, file.parent)
    script = getattr(sys.modules["__main__"], "__file__", None)
    is_script = script is not None and Path(script).resolve() == file.resolve()
    return BadValue(
        f"{file} is being loaded already: it reads this configuration when it is imported{place}",
        expected='that below `if __name__ == "__main__":`'
        + (", or the class as `__main__:Class`" if is_script else ""),
    )


def _list(protocols: list[str]) -> str:
    return f"; there are {', '.join(protocols)}" if protocols else ""


def _error_text(error: BaseException, folder: Path | None = None) -> str:
    """What was raised, and the innermost line of the user's own files that led to it."""
    text = "".join(traceback.format_exception_only(error)[-1:]).strip()
    if isinstance(error, SyntaxError) and error.filename and error.lineno:
        return f"{text} ({error.filename}:{error.lineno})" if "line " not in text else text
    return f"{text}{_place(error, folder)}"


def _place(error: BaseException, folder: Path | None) -> str:
    """That innermost line, in parentheses."""
    frames = [
        frame for frame in traceback.extract_tb(error.__traceback__) if "importlib" not in frame.filename
    ]
    own = [
        frame
        for frame in frames
        if folder is not None and Path(frame.filename).resolve().is_relative_to(folder.resolve())
    ]
    place = (own or frames)[-1:]
    return f" ({place[0].filename}:{place[0].lineno})" if place else ""
