"""The text and drawings of docs/explanation/how-the-engine-works.md agree with runs."""

import importlib.util
import re
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

pytest.importorskip("gradysim._netsim")
pytest.importorskip("matplotlib")

PAGE = "docs/explanation/how-the-engine-works.md"
DRAWINGS = "docs/pictures/engine/draw.py"


@pytest.fixture(scope="module")
def drawings(root: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location("drawings_of_the_engine", root / DRAWINGS)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def page(root: Path) -> str:
    return " ".join((root / PAGE).read_text(encoding="utf-8").split())


def test_the_trace_is_the_one_that_is_shown(
    root: Path,
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
) -> None:
    (command,) = code_blocks(PAGE, "sh")
    shows(PAGE, shell(command, root))


def test_the_functions_in_the_drawing_are_there(root: Path, drawings: ModuleType) -> None:
    texts = " ".join(name for name, _ in (*drawings.SENDER, *drawings.RECEIVER))
    named = set(re.findall(r"\w+", texts))
    sources = [file.read_text() for file in sorted((root / "cpp").rglob("*.[ch]pp"))]
    assert len(named) > 10
    assert [name for name in sorted(named) if not any(name in source for source in sources)] == []


def test_the_counts_of_nodes_are_those_of_the_run(drawings: ModuleType, page: str) -> None:
    field = drawings.Field()
    assert f"The {len(field.notified(0))} radios inside it" in page
    assert f"Of the {len(field.together())} orange nodes" in page


def test_the_listener_waits_for_both_frames_only(drawings: ModuleType, page: str) -> None:
    assert "Without `b` it sends at once" in page
    sent = {}
    for config in ("Energy", "EnergyAlone"):
        scenario, replay = drawings.recorded(config)
        listener = next(spec for spec in scenario.nodes if spec.name == "listener")
        frames = drawings.rows(replay, "frames")
        (sent[config],) = [frame["time_ns"] for frame in frames if frame["node"] == listener.id]
    ends_ns = frames[0]["time_ns"] + frames[0]["duration_ns"]
    assert sent["EnergyAlone"] == listener.protocol_parameters["at"] * 1e9
    assert sent["Energy"] > ends_ns
