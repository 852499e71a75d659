"""Translates lines about what nodes run: protocols, applications, and the missions of vehicles."""

import re
from collections.abc import Sequence
from fnmatch import fnmatchcase
from pathlib import Path

from gradysim.omnetpp_import.missions import read_mission
from gradysim.omnetpp_import.outcome import Action, Outcome, left_out, not_modelled, renamed
from gradysim.omnetpp_import.scene import Scene, group_in
from gradysim.omnetpp_import.tables import (
    APPS,
    CLASS_NAMES,
    CLASS_TO_WRITE,
    DRAWN,
    FILE_NAME,
    LOCATION,
    OTHER_APP,
    PROTOCOL,
    PROTOCOL_PARAMETERS,
    SHOWCASES,
)
from gradysim.omnetpp_import.values import wrong_value
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.position import Position
from gradysim.scenario.parse.distributions import distribution_in
from gradysim.scenario.parse.functions import is_quoted, unquoted
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.schema.parameters import parameters_of

_STRING = re.compile(r'"[^"]*"')
_NAMED_VALUES = re.compile(r"\$\{\s*(\w+)\s*=(?!=)", re.ASCII)


class ProtocolTranslator:
    """Translates the lines of a file that are about protocols."""

    def __init__(self, entries: Sequence[Entry], scene: Scene, folder: str) -> None:
        """Take all lines of the file, and the directory of the file from that of the translation."""
        self._scene = scene
        self._folder = folder
        self._of_protocols: dict[str, dict[str, Entry]] = {}
        self._typenames: dict[str, set[str]] = {}
        for entry in entries:
            module, _, name = entry.key.rpartition(".")
            if module.endswith(".protocol"):
                self._of_protocols.setdefault(module, {})[name] = entry
            if name == "typename" and module.endswith((".protocol", ".app[0]", ".app[*]")):
                self._typenames.setdefault(group_in(module), set()).add(_unquoted(entry.text))
        self._patterns = [group for group in self._typenames if not group.isidentifier()]

    def outcome(self, entry: Entry, parts: Sequence[str]) -> Outcome | None:
        """Return what becomes of a line; None if it is not about protocols of this package."""
        if len(parts) < 3:
            return None
        node, module, name = ".".join(parts[:-2]), parts[-2], parts[-1]
        if module == "protocol":
            return self._protocol(entry, node, name)
        if module.startswith("app["):
            if module not in ("app[0]", "app[*]"):
                return not_modelled(entry, OTHER_APP)
            if name == "typename":
                return self._app(entry, node)
            module = "app"
        for parameter in PROTOCOL_PARAMETERS.get(f"{module}.{name}", ()):
            if outcome := self._parameter(entry, node, parameter):
                return outcome
        return None

    @staticmethod
    def _app(entry: Entry, node: str) -> Outcome | None:
        app = _unquoted(entry.text)
        if app in SHOWCASES:
            return renamed(entry, f"{node}.protocol.class", reference(app))
        key, _, text = APPS.get(app, "").partition(" = ")
        return renamed(entry, f"{node}.{key}", text) if key else None

    def _protocol(self, entry: Entry, node: str, name: str) -> Outcome:
        """Translate a parameter of a protocol. In GrADyS' project, several name a class in Python."""
        python = self._of_protocols.get(f"{node}.protocol", {})
        class_key = next((key for key in CLASS_NAMES if key in python), PROTOCOL)
        if name == "typename":
            protocol = _unquoted(entry.text)
            if protocol in SHOWCASES:
                return renamed(entry, f"{node}.protocol.class", reference(protocol))
            if protocol.startswith("Python"):
                return left_out(entry, "another line names the class")
            what = f"in Python, what {protocol} does"
            return Outcome(Action.TO_WRITE, entry, f"{node}.{CLASS_TO_WRITE}", what)
        if name not in (*CLASS_NAMES, FILE_NAME, LOCATION, PROTOCOL):
            parameter = re.sub("(?<=[a-z])(?=[A-Z])", "_", name).lower()
            return self._parameter(entry, node, parameter) or self._other_parameter(entry, node)
        if name != class_key or FILE_NAME not in python:
            return left_out(entry, "part of `protocol.class`")
        texts = {key: unquoted(other.text) for key, other in python.items() if is_quoted(other.text)}
        if not texts.keys() >= {FILE_NAME, class_key}:
            note = "the name of its file or class is not in quotes"
            return Outcome(Action.TO_WRITE, entry, f"{node}.{CLASS_TO_WRITE}", note)
        folders = [self._folder, texts.get(LOCATION, ".")]
        folders += [texts[PROTOCOL]] if class_key != PROTOCOL and PROTOCOL in texts else []
        file = Path(*folders) / f"{texts[FILE_NAME].removesuffix('.py')}.py"
        return renamed(entry, f"{node}.protocol.class", f'"{file.as_posix()}:{texts[class_key]}"')

    def _parameter(self, entry: Entry, node: str, parameter: str) -> Outcome | None:
        """Return the outcome of a parameter of a protocol in `SHOWCASES`; None if the node has none."""
        kinds = [parameters_of(protocol).get(parameter) for protocol in self._protocols(node)]
        kind = next(filter(None, kinds), None)
        if kind is None:
            return None
        key, text = f"{node}.protocol.{parameter}", entry.text
        if parameter in ("send_interval", "message_length") and distribution_in(text):
            return not_modelled(entry, DRAWN)
        try:
            text = self._mission(entry) if parameter == "mission" else text
        except ValueError as error:
            return Outcome(Action.TO_WRITE, entry, f"{key} = ...", str(error))
        if wrong := wrong_value(entry, key, text, {f"protocol.{parameter}": kind}):
            return Outcome(Action.TO_WRITE, entry, f"{key} = ...", f"{text}: {wrong}")
        return renamed(entry, key, text)

    def _other_parameter(self, entry: Entry, node: str) -> Outcome:
        if self._protocols(node) and all(name in SHOWCASES for name in self._names(node)):
            return not_modelled(entry, "there is no such parameter")
        note = "if it is an attribute of your class"
        return Outcome(Action.TO_WRITE, entry, f"{entry.key} = {entry.text}", note)

    def _protocols(self, node: str) -> list[type[IProtocol]]:
        return [SHOWCASES[name] for name in self._names(node) if name in SHOWCASES]

    def _names(self, node: str) -> set[str]:
        """Return the names of the protocols that the file gives the nodes of a key."""
        group, names = group_in(node), self._typenames.get(group_in(node), set())
        others = self._typenames if not group.isidentifier() else self._patterns
        return names.union(
            *(
                self._typenames[other]
                for other in others
                if fnmatchcase(group, other or "*") or fnmatchcase(other, group or "*")
            )
        )

    def _mission(self, entry: Entry) -> str:
        """Return the value with missions instead of the names of their files. Raises ValueError."""
        is_geographic = self._scene.is_geographic(entry.key)

        def to_position(*coordinates: float) -> Position:
            x, y, z = coordinates
            return self._scene.position(entry, x, y, z) if is_geographic else (x, y, z)

        folder = entry.source.file.parent
        missions = {
            file: f'"{read_mission(folder / unquoted(file), to_position)}"'
            for file in _STRING.findall(entry.text)
        }
        if variable := _NAMED_VALUES.match(entry.text):  # whose values stay the names of the files
            subjects = [entry.text, *[f"${{{variable[1]}}}"] * len(missions)]
            cases = zip(subjects, missions.items(), strict=False)
            return " : ".join([*(f"{subject} == {file} ? {text}" for subject, (file, text) in cases), '""'])
        return _STRING.sub(lambda match: missions[match[0]], entry.text)


def reference(protocol: str) -> str:
    """Return the value of `protocol.class` for a protocol in `SHOWCASES`."""
    return f'"{SHOWCASES[protocol].__module__.rpartition(".")[0]}:{protocol}"'


def _unquoted(text: str) -> str:
    return unquoted(text) if is_quoted(text) else text
