"""What docs/how-to/fly-with-inertia.md shows is what happens."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.cli.app import main
from gradysim.scenario.load import load_scenarios

pytest.importorskip("gradysim._netsim")
pytest.importorskip("matplotlib")

GUIDE = "docs/how-to/fly-with-inertia.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def page(saved: Callable[..., Path]) -> Path:
    """Return the directory with the files of the page, which is the current one."""
    return saved(GUIDE, python="square.py", ini="square.ini")


@pytest.mark.verify
def test_its_commands_print_and_draw_what_it_shows(
    page: Path, code_blocks: CodeBlocks, shell: Callable[[str, Path], str], shows: Callable[..., None]
) -> None:
    shows(GUIDE, shell("".join(code_blocks(GUIDE, "sh")), page), part=True)
    assert (page / "results" / "inertia.png").stat().st_size


def test_prototype_mode_prints_the_same(
    page: Path, shows: Callable[..., None], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "square.ini", "--mode", "prototype"]) == 0
    shows(GUIDE, capsys.readouterr().out, part=True)


def test_its_second_configuration_gives_each_node_an_error(page: Path) -> None:
    (scenario,) = load_scenarios(page / "square.ini", "Errors")
    assert [node.mobility["position_error_m"].value for node in scenario.nodes] == [1.5, 1.5]
