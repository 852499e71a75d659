"""The drawing of docs/contributing/architecture.md shows the layers that other tests enforce."""

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

pytest.importorskip("matplotlib")


@pytest.fixture
def drawing(root: Path) -> ModuleType:
    file = root / "docs/pictures/architecture/draw.py"
    spec = importlib.util.spec_from_file_location("drawing_of_the_architecture", file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_drawing_is_up_to_date(drawing: ModuleType) -> None:
    committed = drawing.PICTURE.read_text(encoding="utf-8")
    assert drawing.picture() == committed, "run `python docs/pictures/architecture/draw.py`"


def test_every_layer_has_a_box(drawing: ModuleType) -> None:
    layers = {name for names in drawing.python_layers() for name in names}
    assert drawing.CONTENTS.keys() == layers | set(drawing.engine_layers()) | {"proxy_protocol", "protocols"}
