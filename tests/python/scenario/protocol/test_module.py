import sys
from pathlib import Path
from types import ModuleType

import pytest

from gradysim.scenario.protocol.module import ModuleLoader


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


def test_a_module_of_somebody_else_with_a_siblings_name_comes_back(
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


def test_loads_a_file_once_and_anew_with_another_loader(tmp_path: Path) -> None:
    file = write(tmp_path, mobile="THING = object()") / "mobile.py"
    loader = ModuleLoader()
    thing = loader.load(file).THING
    assert loader.load(file).THING is thing
    assert ModuleLoader().load(file).THING is not thing


def test_a_file_that_is_no_python_source_is_refused(tmp_path: Path) -> None:
    (tmp_path / "mobile.txt").write_text("VALUE = 1")
    with pytest.raises(ImportError, match=r"^mobile\.txt is no Python source file$"):
        ModuleLoader().load(tmp_path / "mobile.txt")
