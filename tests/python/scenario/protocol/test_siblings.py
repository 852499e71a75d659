"""What lies beside the files of protocols, while a run goes on."""

import importlib
import sys
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario.protocol.loader import ProtocolLoader
from gradysim.scenario.protocol.siblings import siblings_importable
from python.quiet_protocol import Quiet

TESTED = """
from gradysim.protocol.interface import IProtocol
from sibling_y import THING


class Tested(IProtocol):
    thing = THING
    def initialize(self): pass
    def handle_timer(self, timer): pass
    def handle_packet(self, message): pass
    def handle_telemetry(self, telemetry): pass
    def finish(self): pass
"""


def load(folder: Path) -> Any:
    folder.mkdir(exist_ok=True)
    (folder / "tested.py").write_text(TESTED)
    (folder / "sibling_y.py").write_text("THING = object()")
    return ProtocolLoader().load("tested.py:Tested", folder)


def test_a_file_is_the_one_that_was_imported_when_the_protocol_was(tmp_path: Path) -> None:
    tested = load(tmp_path)
    with siblings_importable([tested]):
        assert importlib.import_module("sibling_y").THING is tested.thing
    assert "sibling_y" not in sys.modules


def test_a_file_that_nobody_imported_before_is_loaded_once(tmp_path: Path) -> None:
    tested = load(tmp_path)
    (tmp_path / "sibling_z.py").write_text("THING = object()")
    things = []
    for _ in range(2):
        with siblings_importable([tested]):
            things.append(importlib.import_module("sibling_z").THING)
    assert things[0] is things[1]


def test_afterwards_all_is_as_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    others = type(sys)("sibling_y")
    tested = load(tmp_path)
    monkeypatch.setitem(sys.modules, "sibling_y", others)
    before = (list(sys.path), list(sys.meta_path), set(sys.modules))
    with siblings_importable([tested]):
        assert sys.modules["sibling_y"] is not others
    assert (list(sys.path), list(sys.meta_path), set(sys.modules)) == before
    assert sys.modules["sibling_y"] is others


def test_the_standard_library_is_not_shadowed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tested = load(tmp_path)
    (tmp_path / "this.py").write_text("raise ValueError")
    monkeypatch.delitem(sys.modules, "this", raising=False)
    with siblings_importable([tested]):
        assert importlib.import_module("this").s.startswith("Gur Mra")


def test_a_name_that_two_folders_have_is_in_neither(tmp_path: Path) -> None:
    both = [load(tmp_path / name) for name in ("a", "b")]
    (tmp_path / "a" / "only_in_a.py").write_text("")
    with siblings_importable(both):
        importlib.import_module("only_in_a")
        with pytest.raises(ModuleNotFoundError):
            importlib.import_module("sibling_y")
    assert "sibling_y" not in sys.modules


def test_the_same_within_itself_changes_nothing(tmp_path: Path) -> None:
    tested = load(tmp_path)
    with siblings_importable([tested]):
        with siblings_importable([tested]):
            pass
        assert importlib.import_module("sibling_y").THING is tested.thing


def test_another_one_within_goes_without(tmp_path: Path) -> None:
    one, other = (load(tmp_path / name) for name in ("a", "b"))
    with siblings_importable([one]), siblings_importable([other]):
        assert importlib.import_module("sibling_y").THING is one.thing


def test_a_class_of_no_file_has_nothing_beside_it() -> None:
    before = list(sys.meta_path)
    with siblings_importable([Quiet]):
        assert list(sys.meta_path) == before
