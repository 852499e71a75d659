"""The output in docs/how-to/build-a-network-in-python.md is correct."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

PAGE = "docs/how-to/build-a-network-in-python.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def folder(code_blocks: CodeBlocks, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the directory with the page's files, as a reader would save them.

    It is the working directory.
    """
    for language, name in [("ini", "radios.ini"), ("python", "network.py")]:
        (block,) = code_blocks(PAGE, language)
        (tmp_path / name).write_text(block)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def network(folder: Path, imported: Callable[[Path], Any]) -> Any:
    """Import the page's script."""
    return imported(folder / "network.py")


def test_its_command_prints_what_it_shows(
    code_blocks: CodeBlocks, folder: Path, shell: Callable[[str, Path], str], shows: Callable[..., None]
) -> None:
    (command,) = code_blocks(PAGE, "sh")
    shows(PAGE, shell(command, folder))


def test_classes_that_a_function_makes_run_in_both_modes(network: Any) -> None:
    class Farther(network.Listener):  # type: ignore[name-defined, misc]
        """A class made by a function."""

    for result in network.in_both_modes([(network.Greeter, (0, 0, 0)), (Farther, (40, 0, 10))]):
        assert [node.protocol for node in result.nodes] == ["Greeter", "Farther"]
        assert [node.tracked_variables["heard"] for node in result.nodes] == [0, 5]
        assert result.nodes[1].position == (40, 0, 10)


def test_its_types_hold(folder: Path, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(folder / "network.py") == ""
