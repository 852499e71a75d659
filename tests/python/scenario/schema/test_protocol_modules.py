"""Protocol files as modules, their neighbor files, and their classes in other processes."""

import gc
import importlib
import os
import pickle
import sys
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from copy import deepcopy
from multiprocessing import get_context
from pathlib import Path
from types import ModuleType
from typing import Any
from weakref import ref

import pytest

from gradysim.prototype.run import run
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.schema.protocol_modules import ModuleLoader, origin_of, siblings_importable
from gradysim.scenario.schema.protocols import ProtocolLoader
from python.quiet_protocol import Quiet


def write(folder: Path, **files: str) -> Path:
    folder.mkdir(exist_ok=True)
    for name, text in files.items():
        (folder / f"{name}.py").write_text(text)
    return folder


def test_files_of_one_name_are_different_modules(tmp_path: Path) -> None:
    a = write(tmp_path / "a", mobile="VALUE = 1")
    b = write(tmp_path / "b", mobile="VALUE = 2")
    loader = ModuleLoader()
    modules = [loader.load(folder / "mobile.py") for folder in (a, b)]
    assert [module.VALUE for module in modules] == [1, 2]
    assert len({module.__name__ for module in modules}) == 2
    assert all(sys.modules[module.__name__] is module for module in modules)


def test_siblings_can_be_imported_and_do_not_collide(tmp_path: Path) -> None:
    a = write(tmp_path / "a", mobile="from sibling_x import VALUE", sibling_x="VALUE = 1")
    b = write(tmp_path / "b", mobile="from sibling_x import VALUE", sibling_x="VALUE = 2")
    loader = ModuleLoader()
    assert [loader.load(folder / "mobile.py").VALUE for folder in (a, b)] == [1, 2]


def test_a_sibling_is_shared_by_the_files_of_its_folder(tmp_path: Path) -> None:
    text = "from sibling_x import THING"
    folder = write(tmp_path, mobile=text, sensor=text, sibling_x="THING = object()")
    loader = ModuleLoader()
    assert loader.load(folder / "mobile.py").THING is loader.load(folder / "sensor.py").THING


def test_packages_beside_the_file_can_be_imported(tmp_path: Path) -> None:
    write(tmp_path / "package_x", __init__="", part="VALUE = 1")
    write(tmp_path, mobile="from package_x.part import VALUE")
    assert ModuleLoader().load(tmp_path / "mobile.py").VALUE == 1
    assert not [name for name in sys.modules if name.startswith("package_x")]


def test_a_module_from_elsewhere_with_the_name_of_a_sibling_comes_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    others = type(sys)("sibling_x")
    monkeypatch.setitem(sys.modules, "sibling_x", others)
    write(tmp_path, mobile="from sibling_x import VALUE", sibling_x="VALUE = 1")
    assert ModuleLoader().load(tmp_path / "mobile.py").VALUE == 1
    assert sys.modules["sibling_x"] is others


def test_a_module_that_imports_others_when_it_is_looked_at_does_no_harm(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Lazy(ModuleType):
        def __getattr__(self, name: str) -> str:
            monkeypatch.setitem(sys.modules, "imported_by_sibling_x", ModuleType("imported_by_sibling_x"))
            raise AttributeError(name)

    monkeypatch.setitem(sys.modules, "sibling_x", Lazy("sibling_x"))
    folder = write(tmp_path, mobile="from sibling_x import VALUE", sibling_x="VALUE = 1")
    assert ModuleLoader().load(folder / "mobile.py").VALUE == 1


def test_the_library_is_not_shadowed(tmp_path: Path) -> None:
    write(
        tmp_path,
        mobile="import gradysim.protocol.interface as i",
        gradysim="raise RuntimeError",
    )
    assert ModuleLoader().load(tmp_path / "mobile.py").i is sys.modules["gradysim.protocol.interface"]


@pytest.mark.parametrize("text", ["import sibling_x", "import sibling_x\nraise ValueError"])
def test_leaves_path_and_siblings_as_they_were(tmp_path: Path, text: str) -> None:
    write(tmp_path, mobile=text, sibling_x="")
    path, names = list(sys.path), set(sys.modules)
    try:
        ModuleLoader().load(tmp_path / "mobile.py")
    except ValueError:
        assert set(sys.modules) == names
    assert sys.path == path
    assert "sibling_x" not in sys.modules


def test_another_loader_loads_a_file_again(tmp_path: Path) -> None:
    file = write(tmp_path, mobile="THING = object()") / "mobile.py"
    loader = ModuleLoader()
    thing = loader.load(file).THING
    assert loader.load(file).THING is thing
    assert ModuleLoader().load(file).THING is not thing


def test_an_edit_within_a_second_that_keeps_the_size_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    loaded = []
    for value in (1, 2):
        write(tmp_path, mobile=f"from sibling_x import VALUE\nOWN = {value}", sibling_x=f"VALUE = {value}")
        for file in tmp_path.glob("*.py"):
            os.utime(file, (1e9, 1e9))
        module = ModuleLoader().load(tmp_path / "mobile.py")
        loaded.append((module.OWN, module.VALUE))
    assert loaded == [(1, 1), (2, 2)]
    assert not sys.dont_write_bytecode


def test_a_file_that_is_not_python_source_is_refused(tmp_path: Path) -> None:
    (tmp_path / "mobile.txt").write_text("VALUE = 1")
    with pytest.raises(ImportError, match=r"mobile\.txt"):
        ModuleLoader().load(tmp_path / "mobile.txt")


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


def test_a_file_that_was_not_imported_before_is_loaded_once(tmp_path: Path) -> None:
    tested = load(tmp_path)
    (tmp_path / "sibling_z.py").write_text("THING = object()")
    things = []
    for _ in range(2):
        with siblings_importable([tested]):
            things.append(importlib.import_module("sibling_z").THING)
    assert things[0] is things[1]


def test_path_and_modules_are_restored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    others = type(sys)("sibling_y")
    tested = load(tmp_path)
    monkeypatch.setitem(sys.modules, "sibling_y", others)
    before = (list(sys.path), set(sys.modules))
    with siblings_importable([tested]):
        assert sys.modules["sibling_y"] is not others
    assert (list(sys.path), set(sys.modules)) == before
    assert sys.modules["sibling_y"] is others


def test_the_standard_library_is_not_shadowed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tested = load(tmp_path)
    (tmp_path / "this.py").write_text("raise ValueError")
    monkeypatch.delitem(sys.modules, "this", raising=False)
    with siblings_importable([tested]):
        assert importlib.import_module("this").s.startswith("Gur Mra")


def test_a_name_that_two_folders_have_cannot_be_imported(tmp_path: Path) -> None:
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


def test_a_scenario_within_another_one_has_its_own_files(tmp_path: Path) -> None:
    one, other = (load(tmp_path / name) for name in ("a", "b"))
    with siblings_importable([one]):
        with siblings_importable([other]):
            assert importlib.import_module("sibling_y").THING is other.thing
        assert importlib.import_module("sibling_y").THING is one.thing


def test_another_thread_goes_without(tmp_path: Path) -> None:
    one, other = (load(tmp_path / name) for name in ("a", "b"))

    def imported() -> object:
        with siblings_importable([other]):
            return importlib.import_module("sibling_y").THING

    with siblings_importable([one]), ThreadPoolExecutor(1) as pool:
        assert pool.submit(imported).result() is one.thing


def test_a_class_of_no_file_has_nothing_beside_it() -> None:
    before = list(sys.path)
    with siblings_importable([Quiet]):
        assert sys.path == before


COUNTED = """[General]
sim-time-limit = 2s
repeat = 2
*.numUavs = 3
*.uavs[*].protocol.class = "shared.py:Counting"
*.boat.protocol.class = "shared.py:Other"
"""
SHARED = """
from protocols import Sensor

created = []


class Counting(Sensor):
    def initialize(self):
        created.append(self)
        self.provider.tracked_variables["number"] = len(created)


class Other(Counting):
    pass
"""


@pytest.fixture
def scenarios(folder: Any) -> list[Scenario]:
    folder.write("shared.py", SHARED)
    folder.write("test.ini", COUNTED)
    return load_scenarios(folder.ini)


def numbers(scenario: Scenario) -> tuple[set[type], list[Any]]:
    """Return the classes of the UAVs, and the counts of all nodes in a run."""
    classes = {node.protocol for node in scenario.nodes[:3]}
    return classes, [node.tracked_variables["number"] for node in run(scenario).nodes]


def run_elsewhere(scenario: Scenario) -> tuple[int, list[Any]]:
    classes, counted = numbers(scenario)
    return len(classes), counted


def test_a_class_stays_itself_in_its_process_also_if_its_file_was_loaded_again(
    scenarios: list[Scenario], folder: Any
) -> None:
    load_scenarios(folder.ini)
    for copied in (pickle.loads(pickle.dumps(scenarios[0])), deepcopy(scenarios[0])):
        assert copied == scenarios[0]
        assert copied.nodes[0].protocol is scenarios[0].nodes[0].protocol


def test_scenarios_run_in_new_processes(scenarios: list[Scenario]) -> None:
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        first, second = pool.map(run_elsewhere, scenarios)
    assert (first, second) == ((1, [1, 2, 3, 4]), (1, [5, 6, 7, 8]))


def test_a_class_of_an_imported_file_comes_from_the_one_that_was_named(folder: Any) -> None:
    named = folder.write("named.py", "from protocols import Mobile as Drone")
    cls = ProtocolLoader().load("named.py:Drone", folder.path)
    origin = origin_of(cls)
    assert origin is not None
    assert (origin.file, origin.name) == (named, "Drone")
    assert pickle.loads(pickle.dumps(origin)).load() is cls


def test_another_process_loads_the_file_once(folder: Any) -> None:
    origins = [origin_of(ProtocolLoader().load("protocols.py:Mobile", folder.path)) for _ in range(2)]
    elsewhere = [pickle.dumps(origin).replace(origin.loader.name.encode(), b"0" * 32) for origin in origins]
    one, other = (pickle.loads(origin).load() for origin in elsewhere)
    assert one is other
    assert one.__name__ == "Mobile"


def test_a_class_that_was_imported_by_its_name_has_no_origin() -> None:
    assert origin_of(Quiet) is None


def test_a_class_that_is_no_longer_used_is_freed(folder: Any) -> None:
    cls = ref(ProtocolLoader().load("protocols.py:Mobile", folder.path))
    ProtocolLoader().load("protocols.py:Mobile", folder.path)
    gc.collect()
    assert cls() is None


def test_a_folder_is_listed_again_only_when_it_has_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    tested = load(tmp_path)
    os.utime(tmp_path, (0, 0))
    listed = []
    scandir = os.scandir
    monkeypatch.setattr(os, "scandir", lambda folder: (listed.append(folder), scandir(folder))[1])
    counts = []
    for time_s in (0, 0, 1, 1):
        os.utime(tmp_path, (time_s, time_s))
        with siblings_importable([tested]):
            counts.append(len(listed))
    assert counts == [1, 1, 2, 2]
